"""Imports point only downward: a package depends on those that come before it in ORDER, and no module on itself."""

import ast
import functools
import re
import xml.etree.ElementTree as ET

import pytest

from conftest import PACKAGES, ROOT

ORDER = ["jetbot", "jetbot_ros", "jetbot_camera", "jetbot_cockpit", "jetbot_control_node", "jetbot_tools",
         "workshop", "simulation", "driving_tasks", "jetbot_class", "jetbot_lessons"]
MANIFESTS = {manifest.parent.name: manifest for manifest in sorted(PACKAGES.glob("**/package.xml"))
             if ROOT / "tests" not in manifest.resolve().parents}
FILES = [(package, file) for package, manifest in MANIFESTS.items()
         for file in sorted(manifest.parent.glob("s*/**/*.py"))]
MODULES = {re.sub(r"(/__init__)?\.py$", "", file.relative_to(folder).as_posix()).replace("/", "."): file
           for folder in sorted(PACKAGES.glob("**/src")) for file in sorted(folder.rglob("*.py"))}
ROS = r"ros|genpy|\w+_msgs$|tf2|diagnostic_updater"
PURE = {  # modules and packages, and what they must not import
    "jetbot": ROS,
    "jetbot_cockpit.session": ROS + "|tornado|socket$|time$",
    "jetbot_cockpit.classroom": ROS + "|tornado|socket$|time$",
    "simulation.world": ROS,
    "simulation.picture": ROS + "|time$",
    "simulation.variation": ROS + "|time$",
    "simulation.diff_drive": ROS + "|time$",
    "simulation.simulated_robot": ROS + "|time$",
    "driving_tasks.scoring": ROS + "|matplotlib|time$",
}


@functools.lru_cache(maxsize=None)
def imported(file):
    """Return the dotted names that a file imports, at whatever place in it."""
    names = set()
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            folders = file.relative_to(PACKAGES).parts[:-1]
            base = folders[folders.index("src") + 1:len(folders) + 1 - node.level] if node.level else ()
            names |= {".".join([*base, *filter(None, [node.module]), alias.name]) for alias in node.names}
    return names


def depends(package):
    """Return what a package.xml names for building or running."""
    return {each.text for each in ET.parse(MANIFESTS[package]).getroot() if each.tag in ("depend", "exec_depend")}


def first(names):
    """Return the packages of dotted names."""
    return {name.partition(".")[0] for name in names}


def test_each_package_has_its_place():
    for package, manifest in MANIFESTS.items():
        above = f'"{package}", after {", ".join(sorted(depends(package) & set(ORDER))) or "nothing"}'
        assert package in ORDER, f"write into ORDER of tests/unit/test_layers.py: {above} ({manifest})"
    assert not set(ORDER) - set(MANIFESTS), "delete from ORDER of tests/unit/test_layers.py what is no package any more"


def test_a_package_depends_on_those_below_it():
    for package in MANIFESTS:
        assert depends(package) & set(ORDER) <= set(ORDER[:ORDER.index(package)]), package


def test_what_a_module_imports_is_a_dependency_of_its_package():
    for package, file in FILES:
        assert first(imported(file)) & set(ORDER) - {package} <= depends(package), file


@pytest.mark.parametrize("name", PURE)
def test_what_needs_no_ros_imports_none(name):
    modules = [module for module in MODULES if f"{module}.".startswith(f"{name}.")]
    assert modules
    for module in modules:
        assert not [each for each in first(imported(MODULES[module])) if re.match(PURE[name], each)], module


@functools.lru_cache(maxsize=None)
def uses(module):
    """Return the modules that a module imports; a package's own name stands for its __init__."""
    names = {name if name in MODULES else name.rpartition(".")[0] for name in imported(MODULES[module])}
    return names & set(MODULES) - {module}


def test_no_module_imports_itself_by_others():
    for module in MODULES:
        below, queue = set(), [module]
        while queue:
            new = uses(queue.pop()) - below
            below |= new
            queue += new
        assert module not in below, module


def test_without_selenium_the_tests_in_a_browser_can_be_read_and_are_skipped():
    drivers = "chromium", "page", "webdriver", "engine_webkit"  # loaded where selenium is there
    for file in (ROOT / "tests/browser").glob("*.py"):
        names = re.findall(r"^(?:from|import) (\.?\w+)", file.read_text(), re.M)
        loads = {"selenium", *(f".{driver}" for driver in drivers)} & set(names)
        assert file.stem in drivers or not loads, file
