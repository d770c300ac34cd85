"""The tools' options come from the rows of the parameters; the commands that they advise work where they started."""

import argparse
import os

import pytest

from jetbot import fake, host
from jetbot_tools.options import add_options, launch_command, parse

LAUNCH = "roslaunch jetbot_control_node jetbot_controller.launch"


@pytest.fixture
def parser(monkeypatch):
    monkeypatch.setenv("JETBOT_PORT", "/dev/ttyUSB0")
    parser = argparse.ArgumentParser("doctor.py", formatter_class=lambda prog: argparse.HelpFormatter(prog, width=200))
    add_options(parser, i2c_bus="every bus", port="", i2c_address="the board's own", board="any")
    return parser


@pytest.mark.parametrize("argument, name, value", [
    ("--i2c-bus=0", "i2c_bus", 0), ("i2c_bus:=7", "i2c_bus", 7), ("_i2c_bus:=7", "i2c_bus", 7),
    (f"i2c_bus:={'9' * 5000}", "i2c_bus", "9" * 5000), ("i2c_bus:=fake", "i2c_bus", "fake:/home/of_ros/fake_i2c"),
    ("i2c_bus:=fake:robot", "i2c_bus", f"fake:{os.getcwd()}/robot"),
    *((word, "i2c_address", 0x61) for word in ("i2c_address:=0x61", "--i2c-address=97", "_i2c_address:=97"))])
def test_options_as_the_shell_and_as_ros_write_them(parser, monkeypatch, argument, name, value):
    monkeypatch.setenv("ROS_HOME", "/home/of_ros")
    assert getattr(parse(parser, [argument]), name) == value


@pytest.mark.parametrize("typed, sentence", [
    ("board:=banana", "The parameter board must be one of jetbot, "),
    *((f"i2c_address:={address}", "The parameter i2c_address must be an address from 0x03 to 0x77, not ")
      for address in ("0x80", "2", "sixty")),
    ("max_speed:=0.5", "There is no argument max_speed:=0.5. See doctor.py --help"),
    ("i2c_bus=fake", "There is no argument i2c_bus=fake. Did you mean i2c_bus:=fake?"),
    ("--i2cbus=7", "There is no argument --i2cbus=7. Did you mean i2c_bus:=7?"),
    ("fake", "There is no argument fake. See doctor.py --help")])
def test_what_cannot_be_meant_is_refused_with_one_sentence(parser, typed, sentence):
    with pytest.raises(SystemExit) as end:
        parse(parser, [typed])
    assert sentence in str(end.value) and "\n" not in str(end.value)


def test_the_help_is_named_as_the_program_was_started(parser, monkeypatch):
    monkeypatch.setenv("MORBOT", "./morbot")
    with pytest.raises(SystemExit, match="See ./morbot doctor --help"):
        parse(parser, ["fake"])


def test_without_an_option_the_environment_is_used(parser):
    assert vars(parse(parser, [])) == {"i2c_bus": None, "port": "/dev/ttyUSB0", "i2c_address": None, "board": None}


@pytest.mark.parametrize("typed, words", [
    ({}, ""), ({"board": "jetbot", "i2c_bus": 1}, ""), ({"i2c_bus": 7}, " i2c_bus:=7"),
    ({"board": "sparkfun", "i2c_bus": "fake:/ros/fake_i2c"}, " board:=sparkfun i2c_bus:=fake"),
    ({"config": "/a b/robot.yaml"}, " 'config:=/a b/robot.yaml'")])
def test_a_command_names_only_what_must_be_typed(monkeypatch, typed, words):
    monkeypatch.setenv("ROS_HOME", "/ros")
    assert launch_command(**typed) == LAUNCH + words


@pytest.mark.parametrize("morbot, launch, doctor, power_on", [
    ("", LAUNCH, "rosrun jetbot_tools doctor.py", "python3 -m jetbot.fake '/my bus'"),
    ("/my robot/morbot", f"'/my robot/morbot' shell {LAUNCH}", "'/my robot/morbot' doctor",
     "'/my robot/morbot' shell python3 -m jetbot.fake '/my bus'")])
def test_commands_after_morbot_need_no_shell_that_knows_ros(monkeypatch, morbot, launch, doctor, power_on):
    monkeypatch.setenv("MORBOT", morbot)
    assert (launch_command(), host.doctor_command(), fake.power_on_command("/my bus")) == (launch, doctor, power_on)
