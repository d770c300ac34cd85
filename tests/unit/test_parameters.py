"""The controller's parameters: which value counts, and one sentence for each that cannot."""

import math

import pytest

from conftest import SOURCE
from jetbot import InvalidValue
from jetbot.boards import BOARDS
from jetbot_control_node.parameters import checked, load, resolve


def test_a_given_value_counts_and_an_empty_one_is_not_given():
    assert checked({"max_speed": 2, "min_duty": ""}) == {**checked({}), "max_speed": 2}


def test_a_mistyped_name():
    with pytest.raises(InvalidValue, match=r"^There is no parameter max_sped. Do you mean max_speed\?$"):
        checked({"max_sped": 2})
    with pytest.raises(InvalidValue, match="^There is no parameter colour. The parameters are .*board, i2c_bus, "):
        checked({"colour": 2})


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
    ("max_duty", 0, "a number above 0, 1 at most"),
    ("acceleration_limit", -1, "a number, 0 or more"),
    ("pwm_frequency", 20, "a number from 24 to 1526"),
    ("i2c_address", 0x78, "an address from 0x03 to 0x77"),
    ("i2c_address", "0x2", "an address from 0x03 to 0x77"),
    ("i2c_address", True, "an address from 0x03 to 0x77"),
])
def test_bad_values(name, value, must):
    with pytest.raises(InvalidValue) as error:
        checked({name: value})
    assert str(error.value) == f"The parameter {name} must be {must}, not {value!r}."


def test_duties_without_a_range_between():
    with pytest.raises(InvalidValue, match="^The min_duty, 0.4, must be below the max_duty, 0.3. Lower the one, or "):
        checked({"min_duty": 0.4, "max_duty": 0.3})


def test_the_file_in_ros_home_is_used_where_it_exists(ros_home):
    assert resolve({}) == {**checked({}), "config": ""}
    (ros_home / "jetbot.yaml").write_text("max_speed: 0.5\ninvert_left: true\nboard: sparkfun")
    assert resolve({}) == {**checked({"max_speed": 0.5, "invert_left": True, "board": "sparkfun"}),
                           "config": f"{ros_home}/jetbot.yaml"}


def test_a_file_of_this_package_needs_no_path_but_comes_after_ones_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert resolve({"config": "si_units.yaml"})["config"] == str(SOURCE / "config/si_units.yaml")
    (tmp_path / "si_units.yaml").write_text("max_speed: 0.5")
    assert resolve({"config": "si_units.yaml"})["max_speed"] == 0.5


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
    assert resolve(typed) == {**checked(typed), "config": ""}


def test_a_fake_robot_reads_the_file_that_is_named(ros_home, monkeypatch):
    monkeypatch.chdir(ros_home)
    (ros_home / "mine.yaml").write_text("max_speed: 0.5")
    parameters = resolve({"i2c_bus": "fake", "config": "mine.yaml"})
    assert (parameters["max_speed"], parameters["config"]) == (0.5, f"{ros_home}/mine.yaml")


def test_a_fake_port_alone_is_a_jetbot_pros(ros_home):
    (ros_home / "jetbot.yaml").write_text("board: jetbot_pro\nswap_motors: true")
    assert resolve({"port": "fake"}) == {**checked({"port": "fake", "board": "jetbot_pro"}), "config": ""}


@pytest.mark.parametrize("typed, config, sentence", [
    ({"i2c_bus": "fake", "board": "jetbot_pro"}, "max_speed: 1",
     "The i2c_bus is fake, but the board jetbot_pro is on the port /dev/ttyACM0. Without a robot, add port:=fake"),
    ({"i2c_bus": "fake"}, "board: jetbot_pro\nport: /dev/ttyUSB0",
     "The i2c_bus is fake, but the board jetbot_pro is on the port /dev/ttyUSB0. Without a robot, add port:=fake"),
    ({"port": "fake"}, "board: sparkfun",
     "The port is fake, but the board sparkfun is on the i2c_bus 1. Without a robot, add i2c_bus:=fake")])
def test_who_types_fake_never_drives_a_real_robot(tmp_path, typed, config, sentence):
    (tmp_path / "robot.yaml").write_text(config)
    with pytest.raises(InvalidValue) as error:
        resolve({**typed, "config": str(tmp_path / "robot.yaml")})
    assert error.value.text("add {}:=fake".format) == sentence


@pytest.mark.parametrize("typed, config", [
    ({"i2c_bus": "fake"}, "board: jetbot_pro\nport: fake"),
    ({"i2c_bus": "fake", "board": "jetbot_pro", "port": "/dev/ttyUSB0"}, "max_speed: 1")])
def test_a_place_that_is_named_counts(tmp_path, typed, config):
    (tmp_path / "robot.yaml").write_text(config)
    assert resolve({**typed, "config": str(tmp_path / "robot.yaml")})["board"] == "jetbot_pro"


@pytest.mark.parametrize("content, reason", [
    (b"# max_speed: 2", "it holds no parameters"),
    (b"42", "it holds no parameters"),
    (b"[board, jetbot]", "it holds no parameters"),
    (b"a: [", "line 1: expected the node content, but found '<stream end>'"),
    (b"max_speed: [1, 2]", "it must give max_speed one value"),
    (b"max_speed:", "it must give max_speed one value"),
    (b"max_speed: ''", "it must give max_speed one value"),
    (b"a: 1\n\tb: 2", r"line 2: found character '\t' that cannot start any token"),
    (b"a: 1\n---\nb: 2", "line 2: but found another document"),
    (b"a: 2020-13-45", "month must be in 1..12"),
    (b"a: 1" + 900 * b":59" + b".0", "int too large to convert to float"),
], ids=lambda value: repr(value)[:20])
def test_a_file_that_cannot_be_used(tmp_path, content, reason):
    file = tmp_path / "robot.yaml"
    file.write_bytes(content)
    with pytest.raises(InvalidValue) as error:
        load(file)
    message = str(error.value)
    assert message.startswith(f"The file {file} cannot be used: {reason}")  # some Pythons add where it was
    assert message.endswith(". Fix it, or name another file by its whole path.")


@pytest.mark.parametrize("content", [
    b"max_speed: 2020-01-01", b"max_speed: .nan", b"max_speed: 1" + 400 * b"0", b"max_speed: 0x" + 5000 * b"f",
    b"max_speed: " + 5000 * b"9", b"i2c_bus: 0x" + 5000 * b"f", b'board: "\\e[2J"', b"i2c_bus: true", b"yes: 1",
], ids=lambda content: repr(content)[:20])
def test_an_odd_value_in_the_file_gets_one_short_sentence(tmp_path, content):
    (tmp_path / "robot.yaml").write_bytes(content)
    with pytest.raises(InvalidValue) as error:
        resolve({"config": str(tmp_path / "robot.yaml")})
    assert str(error.value).isprintable() and len(str(error.value)) < 2000


@pytest.mark.parametrize("name", ["si_unit.yaml", "~nobody_here/robot.yaml", None])
def test_a_named_file_that_is_missing(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InvalidValue) as error:
        resolve({"config": name})
    assert str(error.value) == (f"There is no file {tmp_path}/{name}. Name a file of your own by its whole path; this "
                                "package has si_units.yaml.")


def test_the_file_in_ros_home_is_never_passed_over(ros_home):
    (ros_home / "jetbot.yaml").symlink_to("not/mounted")
    with pytest.raises(InvalidValue, match="jetbot.yaml cannot be used: No such file or directory"):
        resolve({})
