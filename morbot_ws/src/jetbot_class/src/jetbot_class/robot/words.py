"""What is typed after ./morbot robot: the robot's name, its class, and arguments of the launch file."""

import os
import sys
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Dict, Iterable, List

from jetbot.text import closest, is_printable
from jetbot_cockpit.classroom.place import CLASS_NAME
from jetbot_cockpit.remote.key import ROBOT_NAME, read_key

from .computer import refuse

LAUNCHES = "jetbot_class/launch/robot.launch", "jetbot_control_node/launch/jetbot_controller.launch"
SET_HERE = {"robot", "robot_name", "identity", "classes", "cockpit", "lan", "name", "browser", "required", "output"}
MAX_VALUE = 500  # characters
KEY_ADVICE = "A robot's key has 26 letters and digits; on the teacher's computer: ./morbot fleet key {name}"


def known_arguments(source: Path) -> Iterable[str]:
    """Return the arguments that a robot of a class takes. source: the folder of the packages."""
    names = {arg.get("name", "") for file in LAUNCHES for arg in ET.parse(source / file).getroot().findall("arg")}
    return names - SET_HERE


def split_arguments(words: List[str], known: Iterable[str]) -> Dict[str, str]:
    """Return {name: value} of NAME:=VALUE words. Raise Refused."""
    arguments = {}
    for word in words:
        name, sign, value = word.partition(":=")
        if not sign:
            refuse(f"there is no argument {word} of a robot", "Arguments are written as board:=sparkfun.")
        if name not in known:
            meant = closest(name, known)
            refuse(f"there is no argument {name} of a robot", f"Did you mean {meant}:={value}?" if meant else "")
        if not is_printable(value, MAX_VALUE):
            refuse(f"the value of {name} is not printable, or longer than {MAX_VALUE} characters")
        arguments[name] = value
    return arguments


def read_arguments(words: List[str], known: Iterable[str]) -> Dict[str, str]:
    """Return {name: value} of NAME:=VALUE words; a file gets its whole path. Raise Refused."""
    arguments = split_arguments(words, known)
    if arguments.get("config"):
        if not os.path.isfile(arguments["config"]):
            refuse(f"there is no file {arguments['config']}")
        arguments["config"] = os.path.abspath(arguments["config"])
    return arguments


def check_names(robot: str, class_name: str) -> None:
    """Raise Refused for a name that a robot or a class cannot have."""
    if not ROBOT_NAME.fullmatch(robot):
        refuse(f"{robot} is no name of a robot",
               "It has letters, digits and _, 30 at most, and begins with a letter, such as jetbot_07.")
    if not class_name:
        refuse(f"the class of {robot} is missing", f"Such as: ./morbot robot {robot} --class 7b")
    if not CLASS_NAME.accepts(class_name):
        refuse(f"{class_name} is no name of a class, which has {CLASS_NAME.description}")


def typed_key(robot: str) -> str:
    """Return the robot's own key, from a prompt or else the standard input, "" if nothing is there. Raise Refused."""
    if not sys.stdin.isatty():
        return checked_key(sys.stdin.readline(), robot)
    while True:
        try:
            typed = input(f"Key of {robot} (on the teacher's computer: ./morbot fleet key {robot}): ")
        except EOFError:
            return ""
        if read_key(typed):
            return checked_key(typed, robot)
        print("That is no key: 26 letters and digits, from A to Z and from 2 to 7. Spaces do not matter.")


def checked_key(typed: str, robot: str) -> str:
    """Return a key as it is kept, "" for "". Raise Refused."""
    if not typed.strip():
        return ""
    return read_key(typed) or refuse("that is no key", KEY_ADVICE.format(name=robot))
