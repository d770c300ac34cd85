"""Bad parameters get one sentence; the README and the launch file show the defaults that the node has."""

import math
import re
import xml.etree.ElementTree as ET

import pytest

from conftest import SOURCE
from jetbot import InvalidValue
from jetbot.parameters import PARAMETERS, checked


def test_defaults():
    assert checked({}) == {
        "board": "jetbot", "i2c_bus": 1, "cmd_vel_timeout": 1.0, "wheel_separation": 2.0, "max_speed": 1.0,
        "left_motor_alpha": 1.0, "right_motor_alpha": 1.0}


def test_what_is_given_counts_and_strangers_are_left_out():
    parameters = checked({"max_speed": 2, "something": "else"})
    assert parameters["max_speed"] == 2
    assert "something" not in parameters


@pytest.mark.parametrize("name, value, must", [
    ("board", "lego", "one of jetbot, adafruit, waveshare"),
    ("board", ["jetbot"], "one of jetbot, adafruit, waveshare"),
    ("i2c_bus", 1.5, "a number, fake, or fake:FOLDER"),
    ("cmd_vel_timeout", -1, "a number of seconds, 0 or more"),
    ("cmd_vel_timeout", math.nan, "a number of seconds, 0 or more"),
    ("cmd_vel_timeout", "soon", "a number of seconds, 0 or more"),
    ("max_speed", 0, "a number above 0"),
    ("wheel_separation", math.inf, "a number above 0"),
    ("left_motor_alpha", True, "a number"),
])
def test_bad_values(name, value, must):
    with pytest.raises(InvalidValue) as error:
        checked({name: value})
    assert str(error.value) == f"The parameter {name} must be {must}, not {value!r}."


def test_launch_arguments_are_the_parameters():
    launch = ET.parse(SOURCE / "launch/jetbot_controller.launch").getroot()
    defaults = {arg.get("name"): arg.get("default") for arg in launch.iter("arg") if arg.get("default")}
    del defaults["config"]
    assert defaults == {name: str(parameter.default) for name, parameter in PARAMETERS.items()}
    assert all(arg.get("doc") for arg in launch.findall("arg"))


def test_readme_shows_the_defaults():
    rows = re.findall(r"^\| `(\w+)` \| `([^`]*)`", (SOURCE / "../../../README.md").read_text(), re.M)
    assert dict(rows) == {name: str(parameter.default) for name, parameter in PARAMETERS.items()}
