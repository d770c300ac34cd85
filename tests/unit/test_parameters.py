"""Bad parameters get one sentence; the README and the launch file show the defaults that the node has."""

import math
import re
import xml.etree.ElementTree as ET

import pytest

from conftest import SOURCE
from jetbot import InvalidValue
from jetbot_ros.parameters import PARAMETERS, checked, load

SHOWN_DEFAULTS = {name: str(parameter.default).replace("True", "true").replace("False", "false")
                  for name, parameter in PARAMETERS.items()}


def test_defaults():
    assert checked({}) == {
        "board": "jetbot", "i2c_bus": 1, "cmd_vel_timeout": 1.0, "wheel_separation": 2.0, "max_speed": 1.0,
        "left_motor_alpha": 1.0, "right_motor_alpha": 1.0, "swap_motors": False, "invert_left": False,
        "invert_right": False, "min_duty": 0.0, "port": "/dev/ttyACM0", "publish_tf": False}


def test_what_is_given_counts():
    assert checked({"max_speed": 2})["max_speed"] == 2


def test_a_mistyped_name():
    with pytest.raises(InvalidValue, match="^There is no parameter max_sped. The parameters are board, i2c_bus, "):
        checked({"max_sped": 2})


@pytest.mark.parametrize("name, value, must", [
    ("board", "lego", "one of jetbot, adafruit, waveshare, sparkfun, jetbot_pro"),
    ("board", ["jetbot"], "one of jetbot, adafruit, waveshare, sparkfun, jetbot_pro"),
    ("i2c_bus", 1.5, "a number, fake, or fake:FOLDER"),
    ("cmd_vel_timeout", -1, "a number of seconds, 0 or more"),
    ("cmd_vel_timeout", math.nan, "a number of seconds, 0 or more"),
    ("cmd_vel_timeout", "soon", "a number of seconds, 0 or more"),
    ("max_speed", 0, "a number above 0"),
    ("wheel_separation", math.inf, "a number above 0"),
    ("left_motor_alpha", True, "a number"),
    ("swap_motors", 1, "true or false"),
    ("min_duty", 1, "a number of at least 0 and below 1"),
])
def test_bad_values(name, value, must):
    with pytest.raises(InvalidValue) as error:
        checked({name: value})
    assert str(error.value) == f"The parameter {name} must be {must}, not {value!r}."


def test_launch_arguments_are_the_parameters():
    launch = ET.parse(SOURCE / "launch/jetbot_controller.launch").getroot()
    args = {arg.get("name"): arg.get("default") for arg in launch.findall("arg")}
    assert [args.pop(name) for name in ("config", "robot_name", "required")] == ["", "", "true"]
    assert args == SHOWN_DEFAULTS
    assert all(arg.get("doc") for arg in launch.findall("arg"))


def test_the_launch_file_passes_on_what_differs_from_a_default():
    launch = ET.parse(SOURCE / "launch/jetbot_controller.launch").getroot()
    passed = {param.get("name"): param.get("unless") for param in launch.iter("param")}
    assert passed == {"config": "$(eval config == '')", **{
        name: f"$(eval str({name}) == '{parameter.default}')" for name, parameter in PARAMETERS.items()}}


def test_readme_shows_the_defaults():
    rows = re.findall(r"^\| `(\w+)` \| `([^`]*)`", (SOURCE / "../../../README.md").read_text(), re.M)
    assert dict(rows) == SHOWN_DEFAULTS


def test_a_file_of_parameters(tmp_path):
    (tmp_path / "robot.yaml").write_text("max_speed: 0.5\ninvert_left: true\n")
    assert load(tmp_path / "robot.yaml") == {"max_speed": 0.5, "invert_left": True}


def test_the_file_in_ros_home_is_used_where_it_exists(tmp_path, monkeypatch):
    monkeypatch.setenv("ROS_HOME", str(tmp_path))
    assert load() == {}
    (tmp_path / "jetbot.yaml").write_text("board: sparkfun")
    assert load() == {"board": "sparkfun"}


@pytest.mark.parametrize("text, sentence", [
    (None, "The file {} cannot be read as YAML: .Errno 2. No such file"),
    ("a: [", "The file {} cannot be read as YAML: "),
    ("42", "The file {} holds no parameters, but 42."),
])
def test_a_file_that_cannot_be_used(tmp_path, text, sentence):
    file = tmp_path / "robot.yaml"
    if text is not None:
        file.write_text(text)
    with pytest.raises(InvalidValue, match=sentence.format(file)):
        load(file)
