"""The parameters of the cockpit."""

import re
from typing import Dict

from jetbot import InvalidValue
from jetbot.kinds import BOOLEAN, Kind
from jetbot_ros.contract import COCKPIT_PORT
from jetbot_ros.node_parameters import Parameter, check_values

from .classroom.place import CLASS_NAME, FOLDER

MAX_ROBOTS = 99
MAX_PORT = 65535
HOST = re.compile(r"[A-Za-z0-9.-]*|(?=.*:.*:)[0-9A-Fa-f:.]+")  # the second: an address of IPv6


def integer_to(limit: int) -> Kind:
    """Return the kind of a whole number from 0 to this one."""
    return Kind(lambda value: type(value) is int and 0 <= value <= limit, f"a whole number from 0 to {limit}")


def is_host(value: object) -> bool:
    """Return whether this has the characters of a host's name, of an IP address, or none."""
    return isinstance(value, str) and bool(HOST.fullmatch(value))


def is_folder(value: object) -> bool:
    """Return whether this names a folder wherever it is typed, or is False."""
    return value is False or isinstance(value, str) and value.startswith(("/", "~"))


PARAMETERS = {
    "lan": Parameter(False, BOOLEAN, "true: phones and other computers in the network may use it, with a code"),
    "port": Parameter(COCKPIT_PORT, integer_to(MAX_PORT), "TCP port of the page; 0 takes a free one"),
    "name": Parameter("", Kind(is_host, "a host's name or address, as in http://NAME:8080"),
                      "name or address of this computer that phones can reach it by, where it is not what the computer "
                      "itself finds out"),
    "robots": Parameter(0, integer_to(MAX_ROBOTS), "how many of jetbot_01, jetbot_02 and so on get a code each"),
    "pictures": Parameter("~/jetbot_pictures", Kind(is_folder, "a folder, such as ~/jetbot_pictures, or false"),
                          "folder on this computer for the pictures that people collect on the page; false: none"),
    "class": Parameter("", CLASS_NAME, "name of a class, such as 7b, whose codes, names, programs and best scores are "
                       "kept until ./morbot forget; without one, they end with the cockpit"),
    "classes": Parameter(FOLDER, Kind(lambda value: value is not False and is_folder(value),
                         "a folder, such as ~/classes"), "folder on this computer where classes are kept"),
    "identity": Parameter("", Kind(lambda value: value == "" or value is not False and is_folder(value),
                          "a file, such as ~/.ros/morbot_robot.json"),
                          "file with this robot's name, class and key, which ./morbot robot writes: lets in the hub of "
                          "its class"),
    "browser": Parameter(False, Kind(lambda value: value in (False, "auto"), "false or auto"),
                         "auto: also opens the page, where there is a desktop"),
}


def resolve(typed: Dict[str, object]) -> Dict[str, object]:
    """Return all parameters: what is typed, else the defaults. Raise InvalidValue."""
    parameters = check_values(typed, PARAMETERS)
    if parameters["name"] and not parameters["lan"]:
        raise InvalidValue(f"no other computer reaches this page as {parameters['name']} without lan",
                           "Add lan:=true, or leave out the name.")
    return parameters
