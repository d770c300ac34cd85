"""A parameter is one row: bad values get one sentence, and the launch file and the docs show the rows."""

import math
import re
import xml.etree.ElementTree as ET

import pytest

from conftest import ROOT, SOURCE
from jetbot import InvalidValue
from jetbot.boards import BOARDS
from jetbot_ros.parameters import PARAMETERS, checked, load, resolve

LAUNCH = ET.parse(SOURCE / "launch/jetbot_controller.launch").getroot()


def shown(value):
    """Return a default as YAML and roslaunch write it."""
    return str(value).lower() if isinstance(value, bool) else str(value)


def test_defaults():
    assert checked({}) == {
        "board": "jetbot", "i2c_bus": 1, "cmd_vel_timeout": 1.0, "wheel_separation": 2.0, "max_speed": 1.0,
        "left_motor_alpha": 1.0, "right_motor_alpha": 1.0, "swap_motors": False, "invert_left": False,
        "invert_right": False, "min_duty": 0.0, "port": "/dev/ttyACM0", "publish_tf": False}


def test_a_given_value_counts_and_an_empty_one_is_not_given():
    assert checked({"max_speed": 2, "min_duty": ""}) == {**checked({}), "max_speed": 2}


def test_a_mistyped_name():
    with pytest.raises(InvalidValue, match="^There is no parameter max_sped. The parameters are board, i2c_bus, "):
        checked({"max_sped": 2})


@pytest.mark.parametrize("name, value, must", [
    ("board", "lego", f"one of {', '.join(BOARDS)}"),
    ("board", ["jetbot"], f"one of {', '.join(BOARDS)}"),
    ("i2c_bus", 1.5, "a number, fake, or fake:FOLDER"),
    ("port", 7, "a serial device, a socket:// URL, fake, or fake:FOLDER"),
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


@pytest.mark.parametrize("name", PARAMETERS)
def test_a_launch_argument_shows_its_row_and_is_empty_unless_typed(name):
    row = PARAMETERS[name]
    argument = next(each for each in LAUNCH.findall("arg") if each.get("name") == name)
    assert argument.get("default") == ""
    assert argument.get("doc") == f"{row.doc} ({' '.join(filter(None, (shown(row.default), row.unit)))})"


def test_the_launch_file_passes_every_parameter_on():
    passed = {param.get("name"): param.get("value") for param in LAUNCH.iter("param") if param.get("value")}
    assert passed == {name: f"$(arg {name})" for name in (*PARAMETERS, "config")}
    others = [param.get("name") for param in LAUNCH.iter("param") if set(param.attrib) != {"name", "value"}]
    assert others == ["already_running"]


def test_the_reference_shows_the_rows():
    rows = re.findall(r"^\| `(\w+)` \| `([^`]*)` \| (.*?) ?\| (.*) \|$", (ROOT / "docs/reference.md").read_text(), re.M)
    assert rows == [(name, shown(row.default), row.unit, row.doc) for name, row in PARAMETERS.items()]


def test_the_file_in_ros_home_is_used_where_it_exists(ros_home):
    assert load() == {}
    (ros_home / "jetbot.yaml").write_text("max_speed: 0.5\ninvert_left: true\nboard: sparkfun")
    assert load() == {"max_speed": 0.5, "invert_left": True, "board": "sparkfun"}


@pytest.fixture
def ros_home(tmp_path, monkeypatch):
    monkeypatch.setenv("ROS_HOME", str(tmp_path))
    return tmp_path


@pytest.mark.parametrize("typed, max_speed, timeout", [
    ({}, 0.5, 1.0), ({"max_speed": 0.25}, 0.25, 1.0), ({"max_speed": 1.0}, 1.0, 1.0), ({"max_speed": ""}, 0.5, 1.0),
    ({"cmd_vel_timeout": 3}, 0.5, 3)])
def test_what_is_typed_wins_over_the_file_and_the_file_over_the_default(ros_home, typed, max_speed, timeout):
    (ros_home / "jetbot.yaml").write_text("max_speed: 0.5")
    resolved = resolve(typed)
    assert (resolved["max_speed"], resolved["cmd_vel_timeout"]) == (max_speed, timeout)


@pytest.mark.parametrize("typed", [
    {"i2c_bus": "fake"}, {"i2c_bus": "fake:/tmp/x"}, {"board": "jetbot_pro", "port": "fake"}])
def test_a_fake_robot_reads_nothing_from_the_file_of_the_real_one(ros_home, typed):
    (ros_home / "jetbot.yaml").write_text("max_speed: 0.5\nboard: sparkfun")
    assert resolve(typed) == checked(typed)


def test_a_fake_robot_reads_the_file_that_is_named(ros_home):
    (ros_home / "mine.yaml").write_text("max_speed: 0.5")
    assert resolve({"i2c_bus": "fake", "config": str(ros_home / "mine.yaml")})["max_speed"] == 0.5


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
