"""Imports point only downward: what comes first in this list knows nothing of what comes later."""

import ast
from importlib.util import resolve_name

import pytest

from conftest import SOURCE

LAYERS = [
    "jetbot.errors", "jetbot.wait", "jetbot.kinematics", "jetbot.motor", "jetbot.host",
    "jetbot.fake", "jetbot.fake.chips", "jetbot.fake.jetbot_pro", "jetbot.fake.motors", "jetbot.fake.bus",
    "jetbot.fake.port",
    "jetbot.i2c", "jetbot.serial_link",
    "jetbot.boards.driver", "jetbot.boards.pca9685", "jetbot.boards.pwm_motors", "jetbot.boards.scmd",
    "jetbot.boards.jetbot_pro", "jetbot.boards",
    "jetbot.guard", "jetbot.robot", "jetbot",
    "jetbot_ros", "jetbot_tools"]
ROS = ("rospy", "rosgraph", "roslib", "rospkg")


def modules(room):
    """Yield (name, file) of every module in a room."""
    for file in sorted((SOURCE / "src" / room).rglob("*.py")):
        name = ".".join(file.relative_to(SOURCE / "src").with_suffix("").parts)
        yield name.replace(".__init__", ""), file


def imports(name, file):
    """Yield the absolute name of everything that a module imports."""
    package = name if file.name == "__init__.py" else name.rpartition(".")[0]
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = resolve_name("." * node.level + (node.module or ""), package)
            yield from (f"{base}.{alias.name}" for alias in node.names)


def layer(name):
    """Return the layer of a module, or of a name in it; -1 for what is not ours."""
    while name and name not in LAYERS:
        name = name.rpartition(".")[0]
    return LAYERS.index(name) if name else -1


@pytest.mark.parametrize("name, file", [each for room in ("jetbot", "jetbot_ros", "jetbot_tools")
                                        for each in modules(room) if not each[0].endswith("__main__")])
def test_imports_point_downward(name, file):
    own = layer(name)
    assert own >= 0
    for imported in imports(name, file):
        assert layer(imported) < own or (name.split(".")[0], layer(imported)) in (
            ("jetbot_ros", own), ("jetbot_tools", own)), f"{name} imports {imported}"


@pytest.mark.parametrize("name, file", modules("jetbot"))
def test_the_driver_library_knows_no_ros(name, file):
    assert not [imported for imported in imports(name, file) if imported.split(".")[0] in ROS]
