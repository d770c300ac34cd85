"""What the start line says, and how each status on fake hardware ends."""

from types import SimpleNamespace

import pytest

from jetbot_ros.parameters import checked
from jetbot_ros.summary import start_line, status_suffix, summary


def driver(name="/dev/i2c-1", address=0x60, closed_loop=False):
    return SimpleNamespace(link=SimpleNamespace(name=name, address=address), closed_loop=closed_loop)


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


@pytest.mark.parametrize("address, text", [(0x61, "0x61"), (None, "")])
def test_the_address_is_named(address, text):
    assert summary({**checked({}), "config": ""}, driver(address=address))["address"] == text


@pytest.mark.parametrize("robot, end", [
    (driver(), ""), (driver("fake:/bus"), ", on a fake bus"), (driver("fake:/port", None), ", on a fake port"),
    (driver("/dev/ttyACM0", None), "")])
def test_fake_hardware_is_named(robot, end):
    assert status_suffix(robot) == end
