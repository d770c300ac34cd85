"""Parameters: their defaults, and one sentence for a value that cannot be used."""

import math
from typing import Callable, NamedTuple

from .boards import BOARDS
from .errors import InvalidValue


class Parameter(NamedTuple):
    """A default, and what a value must be: a test and the words for it."""

    default: object
    accepts: Callable[[object], bool]
    description: str


def is_number(value):
    """A finite int or float; not a bool, which YAML's yes and no would give."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


SECONDS = (lambda value: is_number(value) and value >= 0, "a number of seconds, 0 or more")
POSITIVE = (lambda value: is_number(value) and value > 0, "a number above 0")
NUMBER = (is_number, "a number")

PARAMETERS = {
    "board": Parameter("jetbot", lambda value: value in list(BOARDS), f"one of {', '.join(BOARDS)}"),
    "i2c_bus": Parameter(1, lambda value: isinstance(value, (int, str)), "a number, fake, or fake:FOLDER"),
    "cmd_vel_timeout": Parameter(1.0, *SECONDS),
    "wheel_separation": Parameter(2.0, *POSITIVE),
    "max_speed": Parameter(1.0, *POSITIVE),
    "left_motor_alpha": Parameter(1.0, *NUMBER),
    "right_motor_alpha": Parameter(1.0, *NUMBER),
}


def checked(given, parameters=PARAMETERS):
    """All parameters as a dict, from those that were given; InvalidValue for one that cannot be used."""
    for name, parameter in parameters.items():
        if name in given and not parameter.accepts(given[name]):
            raise InvalidValue(f"the parameter {name} must be {parameter.description}, not {given[name]!r}")
    return {name: given.get(name, parameter.default) for name, parameter in parameters.items()}
