"""Parameters: their defaults, and one sentence for a value that cannot be used."""

import math
import os
from pathlib import Path
from typing import Callable, NamedTuple

from jetbot.boards import BOARDS, PORT
from jetbot.errors import InvalidValue
from jetbot.host import ros_home


class Parameter(NamedTuple):
    """A default, and what a value must be: a test and the words for it."""

    default: object
    accepts: Callable[[object], bool]
    description: str


def is_number(value):
    """A finite int or float; not a bool, which YAML's yes and no would give."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < math.inf


SECONDS = (lambda value: is_number(value) and value >= 0, "a number of seconds, 0 or more")
POSITIVE = (lambda value: is_number(value) and value > 0, "a number above 0")
NUMBER = (is_number, "a number")
PART = (lambda value: is_number(value) and 0 <= value < 1, "a number of at least 0 and below 1")
YES_OR_NO = (lambda value: isinstance(value, bool), "true or false")

PARAMETERS = {
    # a list: what a YAML file gives may not be hashable
    "board": Parameter("jetbot", lambda value: value in list(BOARDS), f"one of {', '.join(BOARDS)}"),
    "i2c_bus": Parameter(1, lambda value: isinstance(value, (int, str)), "a number, fake, or fake:FOLDER"),
    "port": Parameter(PORT, lambda value: isinstance(value, str), "a serial device or pyserial URL"),
    "cmd_vel_timeout": Parameter(1.0, *SECONDS),
    "wheel_separation": Parameter(2.0, *POSITIVE),  # m
    "max_speed": Parameter(1.0, *POSITIVE),         # m/s
    "left_motor_alpha": Parameter(1.0, *NUMBER),
    "right_motor_alpha": Parameter(1.0, *NUMBER),
    "swap_motors": Parameter(False, *YES_OR_NO),
    "invert_left": Parameter(False, *YES_OR_NO),
    "invert_right": Parameter(False, *YES_OR_NO),
    "min_duty": Parameter(0.0, *PART),
    "publish_tf": Parameter(False, *YES_OR_NO),
}


def default_file():
    """Where the parameters of this computer's robot are kept: jetbot.yaml in ROS's home (~/.ros)."""
    return ros_home() / "jetbot.yaml"


def load(file=None):
    """The parameters in a YAML file, ``default_file`` where it exists and no other is named.

    Raises InvalidValue for a file that cannot be read or holds something else.
    """
    import yaml  # here, so that doctor.py can tell when it is missing
    path = Path(str(file or default_file())).expanduser().absolute()
    if not file and not os.path.exists(path):
        return {}
    try:
        values = yaml.safe_load(path.read_text()) or {}
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise InvalidValue(f"the file {path} cannot be read as YAML: {' '.join(str(error).split())}") from None
    if not isinstance(values, dict):
        raise InvalidValue(f"the file {path} holds no parameters, but {values!r}")
    return values


def checked(given, parameters=PARAMETERS):
    """All parameters as a dict, from those that were given; InvalidValue for one that cannot be used."""
    strangers = sorted(set(given) - set(parameters), key=str)
    if strangers:
        raise InvalidValue(f"there is no parameter {strangers[0]}", f"The parameters are {', '.join(parameters)}.")
    for name, parameter in parameters.items():
        if name in given and not parameter.accepts(given[name]):
            raise InvalidValue(f"the parameter {name} must be {parameter.description}, not {given[name]!r}")
    return {name: given.get(name, parameter.default) for name, parameter in parameters.items()}
