"""What the first lines say, and how each status on fake hardware ends."""

from types import SimpleNamespace

import pytest

from jetbot.boards import BOARDS
from jetbot_control_node.parameters import checked
from jetbot_control_node.status.summary import start_line, start_warnings, status_suffix, summary


def driver(name="/dev/i2c-1", address=0x60, closed_loop=False):
    return SimpleNamespace(link=SimpleNamespace(name=name, address=address), closed_loop=closed_loop)


def driver_of(board):
    row = BOARDS[board]
    return row.driver(SimpleNamespace(name="", address=row.address))


@pytest.mark.parametrize("typed, config, robot, line", [
    ({}, "/home/pupil/.ros/jetbot.yaml", driver(), "board jetbot on /dev/i2c-1; workshop units: left = x - z, "
     "right = x + z; settings from /home/pupil/.ros/jetbot.yaml"),
    ({"wheel_separation": 0.1125, "max_speed": 0.6}, "", driver("fake:/bus"), "board jetbot on fake:/bus; "
     "m/s and rad/s, with wheels 0.1125 m apart and 0.6 m/s at full power; no file of settings"),
    ({}, "", driver(address=0x61), "board jetbot at 0x61 on /dev/i2c-1; workshop units: left = x - z, right = x + z; "
     "no file of settings"),
    ({"board": "jetbot_pro"}, "", driver("/dev/ttyACM0", None, True),
     "board jetbot_pro on /dev/ttyACM0; m/s and rad/s; no file of settings"),
    ({"board": "sparkfun"}, "/a b/\x1b[2J\udcff\n.yaml", driver(address=0x5D),
     r"board sparkfun on /dev/i2c-1; workshop units: left = x - z, right = x + z; "
     r"settings from /a b/\x1b[2J\udcff\n.yaml")])
def test_start_line(typed, config, robot, line):
    assert start_line(summary({**checked(typed), "config": config}, robot)) == line


@pytest.mark.parametrize("robot, numbers", [(driver(), ("0.1125", "0.6")), (driver(closed_loop=True), ("", ""))])
def test_the_numbers_by_which_others_scale_their_commands(robot, numbers):
    texts = summary({**checked({"wheel_separation": 0.1125, "max_speed": 0.6}), "config": ""}, robot)
    assert (texts["wheel_separation"], texts["max_speed"], texts["address"]) == (*numbers, "0x60")


@pytest.mark.parametrize("board, typed, warnings", [
    ("jetbot_pro", {"max_duty": 0.5, "pwm_frequency": 50}, ["the board jetbot_pro ignores max_duty and pwm_frequency"]),
    ("jetbot_pro", {"max_duty": 1, "publish_odom": True}, ["the board jetbot_pro ignores publish_odom"]),
    ("jetbot_pro", {"wheel_separation": 0.1, "max_speed": 0.6, "min_duty": 0.1},
     ["the board jetbot_pro ignores wheel_separation, max_speed and min_duty"]),
    ("sparkfun", {"max_duty": 0.5, "pwm_frequency": 50}, ["the board sparkfun ignores pwm_frequency"]),
    ("jetbot", {"max_duty": 0.5, "pwm_frequency": 50}, []),
    ("jetbot", {"publish_odom": True}, ["odom is not in metres: add config:=si_units.yaml"]),
    ("jetbot", {"publish_odom": True, "max_speed": 0.6}, [])])
def test_what_does_not_do_what_is_expected_is_named_at_the_start(board, typed, warnings):
    assert start_warnings(checked({"board": board, **typed}), driver_of(board)) == warnings


@pytest.mark.parametrize("robot, end", [
    (driver(), ""), (driver("fake:/bus"), ", on a fake bus"), (driver("fake:/port", None), ", on a fake port"),
    (driver("/dev/ttyACM0", None), "")])
def test_fake_hardware_is_named(robot, end):
    assert status_suffix(robot) == end
