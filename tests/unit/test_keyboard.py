"""teleop:=true says what it needs, and how to get it."""

import pytest

from simulation import keyboard


@pytest.mark.parametrize("package, xterm, environment, sentence", [
    ("", "", {}, "the package teleop_twist_keyboard: git clone https://github.com/ros-teleop/teleop_twist_keyboard.git "
                 "morbot_ws/src/teleop_twist_keyboard && ./morbot setup"),
    ("", "", {"ROS_DISTRO": "noetic"},
     "the package teleop_twist_keyboard: sudo apt install ros-noetic-teleop-twist-keyboard"),
    ("/x", "", {}, "xterm: sudo apt install xterm"),
    ("/x", "/y", {}, "a display; without one, type in another terminal: rosrun teleop_twist_keyboard "
                     "teleop_twist_keyboard.py _key_timeout:=0.7"),
    ("/x", "/y", {"DISPLAY": ":0"}, None)])
def test_what_is_missing(monkeypatch, package, xterm, environment, sentence):
    monkeypatch.setattr(keyboard, "package_folder", lambda name: package)
    monkeypatch.setattr(keyboard.shutil, "which", lambda name: xterm)
    for name in "ROS_DISTRO", "DISPLAY":
        monkeypatch.delenv(name, raising=False)
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    assert keyboard.missing() == sentence
