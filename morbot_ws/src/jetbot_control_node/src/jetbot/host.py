"""The computer that all runs on: its model, its I2C buses, which of them a JetBot's motors are on, and ROS's home."""

import grp
import os
from pathlib import Path

# A part of the model's name: the bus on pins 3 and 5 of the 40-pin header, by NVIDIA's and Raspberry Pi's pinouts.
ROBOT_BUS = {"Jetson Nano": 1, "Xavier NX": 8, "Orin Nano": 7, "Raspberry Pi": 1}


def ros_home():
    """Where ROS keeps a user's files: ROS_HOME, else ~/.ros."""
    return Path(os.environ.get("ROS_HOME") or Path.home() / ".ros")


def model(file=Path("/proc/device-tree/model")):
    """The computer's name as its maker gave it; "" on a computer without one, such as a PC."""
    return file.read_text().rstrip("\0") if file.exists() else ""


def robot_bus(name):
    """The number of the bus that the motors are on, on a computer of this name; None for one that is not known."""
    return next((bus for part, bus in ROBOT_BUS.items() if part in name), None)


def buses(dev=Path("/dev")):
    """The I2C buses there are, as paths, by their numbers."""
    return sorted(dev.glob("i2c-*"), key=lambda path: (len(path.name), path.name))


def permission_advice(device, usual_group):
    """What to do where this user may not open a device, a path in /dev; usual_group: whose such devices mostly are."""
    try:
        number = os.stat(device).st_gid
        group = grp.getgrgid(number).gr_name
    except OSError:  # it is gone again
        group = usual_group
    except KeyError:
        return f"Its group has no name here, as in a container; start that with: --group-add {number}"
    if group == "root":
        give = f"sudo chgrp {usual_group} {device} && sudo chmod g+rw {device}"
        return f"Give it to a group: {give}   and join that: {how_to_join(usual_group)}"
    return f"Join its group with: {how_to_join(group)}"


def how_to_join(group):
    """The command, and what to do after it."""
    return f"sudo usermod -aG {group} $USER   and log in again."


def bus_advice():
    """In a sentence or two, which buses there are and which one to use."""
    there = ", ".join(map(str, buses())) or "no /dev/i2c-* at all"
    usual = robot_bus(model())
    hint = f" On a {model()} the motors are on bus {usual}: i2c_bus:={usual}." if usual is not None else ""
    return f"This computer has {there}.{hint} Without a robot: i2c_bus:=fake (with rosrun, _i2c_bus:=fake)."
