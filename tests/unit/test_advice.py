"""The commands that doctor.py and calibrate.py advise work where these were started."""

import pytest

from jetbot import fake, host
from jetbot_tools import commands

LAUNCH = "roslaunch jetbot_control_node jetbot_controller.launch"


@pytest.mark.parametrize("typed, words", [
    ({}, ""), ({"board": "jetbot", "i2c_bus": 1}, ""), ({"i2c_bus": 7}, " i2c_bus:=7"),
    ({"board": "sparkfun", "i2c_bus": "fake:/ros/fake_i2c"}, " board:=sparkfun i2c_bus:=fake"),
    ({"config": "/a b/robot.yaml"}, " 'config:=/a b/robot.yaml'")])
def test_only_what_must_be_typed(monkeypatch, typed, words):
    monkeypatch.setenv("ROS_HOME", "/ros")
    assert commands.launch(**typed) == LAUNCH + words


@pytest.mark.parametrize("morbot, launch, doctor", [
    ("", LAUNCH, "rosrun jetbot_tools doctor.py"),
    ("./morbot", f"./morbot shell {LAUNCH}", "./morbot doctor"),
    ("/my robot/morbot", f"'/my robot/morbot' shell {LAUNCH}", "'/my robot/morbot' doctor")])
def test_after_morbot_without_a_shell_that_knows_ros(monkeypatch, morbot, launch, doctor):
    monkeypatch.setenv("MORBOT", morbot)
    assert (commands.launch(), host.doctor_command()) == (launch, doctor)


def test_a_board_is_plugged_in_where_morbot_was_typed(monkeypatch):
    monkeypatch.setenv("MORBOT", "./morbot")
    assert fake.power_on_command("/my bus") == "./morbot shell python3 -m jetbot.fake '/my bus'"
