"""Ends roslaunch before it starts anything, if the keyboard's window could not open: python3 -m simulation.keyboard.

The command of a parameter in simulation.launch, where that has ``teleop:=true``.
"""

import os
import shutil
from typing import Optional

from jetbot_ros.launch_arguments import package_folder
from jetbot_ros.roslaunch_command import end_roslaunch, parent_words

TELEOP = "teleop_twist_keyboard"
CLONE = f"git clone https://github.com/ros-teleop/{TELEOP}.git morbot_ws/src/{TELEOP} && ./morbot setup"
APT = f"sudo apt install ros-noetic-{TELEOP.replace('_', '-')}"
RUN = f"rosrun {TELEOP} {TELEOP}.py _key_timeout:=0.7"


def missing() -> Optional[str]:
    """Return what the keyboard's window lacks and how to get it, or None."""
    if not package_folder(TELEOP):
        return f"the package {TELEOP}: {APT if os.environ.get('ROS_DISTRO') == 'noetic' else CLONE}"
    if not shutil.which("xterm"):
        return "xterm: sudo apt install xterm"
    return None if os.environ.get("DISPLAY") else f"a display; without one, type in another terminal: {RUN}"


if __name__ == "__main__":
    lack = missing()
    if lack and parent_words():
        end_roslaunch(f"morbot: teleop:=true needs {lack}")
