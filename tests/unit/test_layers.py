"""Imports point only downward: what comes first in this list knows nothing of what comes later."""

import re

import pytest

from conftest import COCKPIT, ROOT, SIMULATION, SOURCE, TASKS

LAYERS = [f"jetbot/{module}" for module in (
    "text", "errors", "kinds", "files", "wait", "kinematics", "host", "fake/__init__", "fake/files", "fake/chips",
    "fake/jetbot_pro", "fake/motors", "fake/bus", "fake/port", "i2c", "serial_link", "supply", "boards/driver",
    "boards/pca9685", "boards/pwm_motors", "boards/scmd", "boards/jetbot_pro", "boards/__init__", "lock", "motor",
    "guard/process", "guard/peer", "guard/__init__", "open_robots", "robot", "__init__")]
FILES = {str(file.relative_to(SOURCE / "src").with_suffix("")): file for file in (SOURCE / "src").rglob("*.py")}


def imports(module):
    """Yield the paths of all modules of ``jetbot`` that a module imports, as FILES names them."""
    package = module.rpartition("/")[0]
    yield from re.findall(r"^ *import (\w+)", FILES[module].read_text(), re.M)
    for dots, base, names in re.findall(r"^ *from (\.*)([\w.]*) import ([^#\n]*)", FILES[module].read_text(), re.M):
        folder = "/".join(package.split("/")[:len(package.split("/")) + 1 - len(dots)]) if dots else ""
        base = "/".join(filter(None, (folder, base.replace(".", "/"))))
        for path in (f"{base}/{name}" for name in re.findall(r"\w+", names)):
            yield next((each for each in (path, f"{path}/__init__", base, f"{base}/__init__") if each in FILES), path)


@pytest.mark.parametrize("module", [module for module in FILES if module.startswith("jetbot/")])
def test_the_driver_library_imports_downward_and_no_ros(module):
    below = LAYERS[:LAYERS.index(module)] if module in LAYERS else LAYERS
    imported = list(imports(module))
    assert not [path for path in imported if path in FILES and path not in below]
    assert not [path for path in imported if path.startswith(("rospy", "ros", "jetbot_"))]


@pytest.mark.parametrize("module", [module for module in FILES if module.startswith("jetbot_ros/")])
def test_the_node_knows_no_tools(module):
    assert not [path for path in imports(module) if path.startswith("jetbot_tools")]


def siblings(text):
    """Return the names of the modules of its own package that a module imports."""
    return re.findall(r"^from \.(\w+) import", text, re.M) + [
        name for names in re.findall(r"^from \. import ([^#\n]*)", text, re.M) for name in re.findall(r"\w+", names)]


def assert_imports_downward(file, layers, pure, impure):
    """Fail if a module imports one that is not below it in the layers, or a pure one imports what is impure."""
    module, text = file.stem, file.read_text()
    assert not set(siblings(text)) - set(layers[:layers.index(module)])
    assert module not in pure or not re.search(rf"^(?:import|from) (?:{impure})", text, re.M)


PURE = ["protocol", "limits", "client", "access", "handout", "scene", "task", "view", "scores", "trail", "history",
        "lease", "dead_man", "stops", "control", "attendance", "hub"]
COCKPIT_LAYERS = [*PURE, "desktop", "address", "parameters", "frames", "emergency", "task_topics", "robot_topics",
                  "robots", "drive", "listeners", "connections", "pages", "sockets", "server"]


@pytest.mark.parametrize("module", [file.stem for file in (COCKPIT / "src/jetbot_cockpit").glob("[!_]*.py")])
def test_the_cockpit_imports_downward(module):
    assert_imports_downward(COCKPIT / f"src/jetbot_cockpit/{module}.py", COCKPIT_LAYERS, PURE,
                            r"ros|tornado|\w+_msgs|socket|time")


PURE_SIMULATION = ["geometry", "world", "worlds", "collision", "line_sensor", "diff_drive", "step_clock", "stall"]
SIMULATION_LAYERS = [*PURE_SIMULATION, "parameters", "keyboard", "description", "recording", "drawing", "topics",
                     "world_topics", "simulator"]


@pytest.mark.parametrize("module", [file.stem for file in (SIMULATION / "src/simulation").glob("[!_]*.py")])
def test_the_simulation_imports_downward_and_its_model_knows_no_ros(module):
    assert_imports_downward(SIMULATION / f"src/simulation/{module}.py", SIMULATION_LAYERS, PURE_SIMULATION,
                            r"ros|\w+_msgs|time")


PURE_TASKS = ["samples", "course", "drive", "polygon", "measures", "penalties", "tasks", "score", "replay"]
TASKS_LAYERS = [*PURE_TASKS, "child", "bounded", "walk", "marks", "bags", "picture", "arguments", "robot", "announce",
                "bag_writer", "attempt", "live", "contained", "trial", "programs"]


@pytest.mark.parametrize("module", [file.stem for file in (TASKS / "src/driving_tasks").glob("[!_]*.py")])
def test_the_driving_tasks_import_downward_and_their_score_knows_no_ros(module):
    assert_imports_downward(TASKS / f"src/driving_tasks/{module}.py", TASKS_LAYERS, PURE_TASKS,
                            r"ros|\w+_msgs|matplotlib|time")


@pytest.mark.parametrize("file", sorted((ROOT / "tests/browser").glob("*.py")), ids=lambda file: file.stem)
def test_without_selenium_the_tests_in_a_browser_can_be_read_and_are_skipped(file):
    imports = re.findall(r"^(?:from|import) (\.?\w+)", file.read_text(), re.M)
    needs_selenium = file.stem in ("chromium", "page")
    assert needs_selenium or not {"selenium", ".chromium", ".page"} & set(imports)
