"""The simulated robot's parameters: what is refused, and that its size is the same wherever it is told."""

import xml.etree.ElementTree as ET

import pytest

from conftest import SIMULATION, SOURCE
from jetbot import InvalidValue
from jetbot_ros.parameters import checked, load
from jetbot_tools import calibration
from simulation.parameters import PARAMETERS

SIZE = load(SIMULATION / "config/jetbot.yaml")


@pytest.mark.parametrize("name, value, must", [
    ("i2c_bus", 1, "fake, or fake:FOLDER"),
    ("i2c_bus", "faked", "fake, or fake:FOLDER"),
    ("board", "lego", "one of adafruit, waveshare, jetbot, sparkfun"),
    ("dead_band", 1, "a number of at least 0 and below 1"),
    ("dead_band", -0.1, "a number of at least 0 and below 1"),
    ("motor_lag", -1, "a number of seconds, 0 or more"),
    ("wheel_diameter", 0, "a number above 0"),
])
def test_bad_values(name, value, must):
    with pytest.raises(InvalidValue, match=f"The parameter {name} must be {must}, not "):
        checked({name: value}, PARAMETERS)


def test_defaults_are_good():
    defaults = {name: parameter.default for name, parameter in PARAMETERS.items()}
    assert checked(defaults, PARAMETERS) == checked({}, PARAMETERS) == defaults


def test_the_file_of_the_body_tells_the_defaults():
    assert SIZE == {name: PARAMETERS[name].default for name in SIZE}
    assert len(SIZE) == 5


def test_the_controller_reckons_with_the_same_size():
    controller = load(SOURCE / "config/si_units.yaml")
    assert controller == {name: SIZE[name] for name in ("wheel_separation", "max_speed")}
    assert calibration.WHEEL_SEPARATION == SIZE["wheel_separation"]


def test_the_drawn_robot_has_the_same_size():
    robot = ET.parse(SIMULATION / "urdf/jetbot.urdf").getroot()
    for side, sign in (("left", 1), ("right", -1)):
        radius = robot.find(f"link[@name='{side}_wheel']/visual/geometry/cylinder").get("radius")
        place = robot.find(f"joint[@name='{side}_wheel_joint']/origin").get("xyz").split()
        assert float(radius) == SIZE["wheel_diameter"] / 2
        assert float(place[1]) == sign * SIZE["wheel_separation"] / 2


@pytest.mark.parametrize("file", sorted((SIMULATION / "launch").glob("*.launch")), ids=lambda file: file.stem)
def test_every_launch_argument_is_explained(file):
    assert all(arg.get("doc") for arg in ET.parse(file).getroot().findall("arg"))
