"""The tools' options come from the rows of the parameters."""

import argparse
import os

import pytest

from jetbot_control_node.parameters import PARAMETERS
from jetbot_tools.options import add_options, parse


@pytest.fixture
def parser(monkeypatch):
    monkeypatch.setenv("JETBOT_PORT", "/dev/ttyUSB0")
    parser = argparse.ArgumentParser(formatter_class=lambda prog: argparse.HelpFormatter(prog, width=200))
    add_options(parser, i2c_bus="every bus", port="", i2c_address="the board's own")
    return parser


@pytest.mark.parametrize("argument, i2c_bus", [
    ("--i2c-bus=0", 0), ("i2c_bus:=7", 7), ("_i2c_bus:=7", 7), (f"i2c_bus:={'9' * 5000}", "9" * 5000),
    ("i2c_bus:=fake", "fake:/home/of_ros/fake_i2c"), ("i2c_bus:=fake:robot", f"fake:{os.getcwd()}/robot")])
def test_options_as_the_shell_and_as_ros_write_them(parser, monkeypatch, argument, i2c_bus):
    monkeypatch.setenv("ROS_HOME", "/home/of_ros")
    assert parse(parser, [argument]).i2c_bus == i2c_bus


@pytest.mark.parametrize("argument", ["i2c_address:=0x61", "--i2c-address=97", "_i2c_address:=97"])
def test_an_address_is_a_number(parser, argument):
    assert parse(parser, [argument]).i2c_address == 0x61


@pytest.mark.parametrize("typed, value", [("max_speed:=0.5", "0.5"), ("_max_speed:=0.5", "0.5"),
                                          ("--max-speed=0.5", "0.5"), ("max_speed", "VALUE")])
def test_an_argument_of_the_controller_is_sent_there(parser, monkeypatch, typed, value):
    monkeypatch.delenv("MORBOT", raising=False)
    parser.prog = "doctor.py"
    with pytest.raises(SystemExit) as end:
        parse(parser, [typed])
    assert str(end.value) == (
        "max_speed is an argument of the controller, not of doctor.py. Leave it out here; it belongs to: "
        f"roslaunch jetbot_control_node jetbot_controller.launch max_speed:={value}")


def test_a_bad_board_is_refused(parser):
    add_options(parser, board="any")
    with pytest.raises(SystemExit, match="The parameter board must be one of jetbot, .*, not 'banana'"):
        parse(parser, ["board:=banana"])


@pytest.mark.parametrize("address", ["0x80", "2", "sixty"])
def test_a_bad_address_is_refused(parser, address):
    with pytest.raises(SystemExit, match="The parameter i2c_address must be an address from 0x03 to 0x77, not "):
        parse(parser, [f"i2c_address:={address}"])


@pytest.mark.parametrize("typed, advice", [
    ("i2c_bus=fake", "Did you mean i2c_bus:=fake?"), ("i2c_buss:=fake", "Did you mean i2c_bus:=fake?"),
    ("--i2cbus=7", "Did you mean i2c_bus:=7?"), ("fake", "See doctor.py --help")])
def test_a_mistyped_word_is_refused_with_what_was_meant(parser, typed, advice):
    parser.prog = "doctor.py"
    with pytest.raises(SystemExit, match=f"There is no argument {typed}. ".replace("?", ".")) as end:
        parse(parser, [typed])
    assert str(end.value).endswith(advice)


def test_without_an_option_the_environment_is_used(parser):
    assert vars(parser.parse_args([])) == {"i2c_bus": None, "port": "/dev/ttyUSB0", "i2c_address": None}


def test_help_has_the_meaning_and_the_default(parser):
    assert f"{PARAMETERS['i2c_bus'].doc} (default: every bus)" in parser.format_help()
    assert f"{PARAMETERS['port'].doc} (default: /dev/ttyACM0)" in parser.format_help()
