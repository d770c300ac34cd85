"""The parameters. A parameter is one row, for the node, the launch file, YAML comments, command lines and the docs."""

import math
import os
from contextlib import suppress
from pathlib import Path
from typing import Callable, Dict, NamedTuple, Optional, Union

from jetbot import InvalidValue, fake, files
from jetbot.boards import BOARDS, DEFAULT_PORT
from jetbot.host import ros_home
from jetbot.text import literal

MAX_BUS = 2**20 - 1  # Linux's minor numbers have 20 bits


class Kind(NamedTuple):
    """What a value must be: a check, and its description."""

    accepts: Callable[[object], bool]
    description: str


class Parameter(NamedTuple):
    """A row: the default, what a value must be, what it means, and its unit."""

    default: object
    kind: Kind
    doc: str
    unit: str = ""


def is_number(value: object) -> bool:
    """Return whether this is a finite int or float; not a bool, which YAML's yes and no would give."""
    with suppress(OverflowError):  # an int that is too large for a float
        return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
    return False


NUMBER = Kind(is_number, "a number")
POSITIVE = Kind(lambda value: is_number(value) and value > 0, "a number above 0")
SECONDS = Kind(lambda value: is_number(value) and value >= 0, "a number of seconds, 0 or more")
FRACTION = Kind(lambda value: is_number(value) and 0 <= value < 1, "a number of at least 0 and below 1")
BOOLEAN = Kind(lambda value: isinstance(value, bool), "true or false")
# A list: what a YAML file gives may not be hashable.
BOARD = Kind(lambda value: value in list(BOARDS), f"one of {', '.join(BOARDS)}")
BUS = Kind(lambda value: isinstance(value, str) or type(value) is int and 0 <= value <= MAX_BUS,
           "a number, fake, or fake:FOLDER")
SERIAL = Kind(lambda value: isinstance(value, str), "a serial device, a socket:// URL, fake, or fake:FOLDER")

PARAMETERS = {
    "board": Parameter("jetbot", BOARD, "motor board: jetbot (Adafruit's and Waveshare's layout at once), adafruit, "
                                        "waveshare, sparkfun or jetbot_pro"),
    "i2c_bus": Parameter(1, BUS, "I2C bus: N for /dev/i2c-N, fake (no robot needed), or fake:FOLDER"),
    "port": Parameter(DEFAULT_PORT, SERIAL, "serial port of a jetbot_pro: a device, a socket:// URL, fake, or "
                                            "fake:FOLDER"),
    "cmd_vel_timeout": Parameter(1.0, SECONDS, "time without a command after which the robot stops; 0 holds the last "
                                               "command", "s"),
    "wheel_separation": Parameter(2.0, POSITIVE, "distance between the wheels; 2.0 makes it the workshop's "
                                                 "left = x - z, right = x + z", "m"),
    "max_speed": Parameter(1.0, POSITIVE, "speed of a wheel at full power", "m/s"),
    "left_motor_alpha": Parameter(1.0, NUMBER, "trim of the left wheel, for a robot that does not drive straight"),
    "right_motor_alpha": Parameter(1.0, NUMBER, "trim of the right wheel"),
    "swap_motors": Parameter(False, BOOLEAN, "true: the left motor is wired as the right one, and vice versa"),
    "invert_left": Parameter(False, BOOLEAN, "true: the left motor turns the wrong way"),
    "invert_right": Parameter(False, BOOLEAN, "true: the right motor turns the wrong way"),
    "min_duty": Parameter(0.0, FRACTION, "smallest duty that turns a wheel; speeds above 0 start there"),
    "publish_tf": Parameter(False, BOOLEAN, "true: a jetbot_pro publishes tf odom -> base_footprint"),
}


def default_file() -> Path:
    """Return the file that keeps the parameters of this computer's robot: jetbot.yaml in ROS's home (~/.ros)."""
    return ros_home() / "jetbot.yaml"


def load(file: Optional[Union[str, Path]] = None) -> Dict[str, object]:
    """Return the parameters in a YAML file: ``default_file``, if it exists and no other is named.

    Raises InvalidValue for a file that cannot be read or holds something else.
    """
    from .flat_yaml import parse  # here: doctor.py reports that YAML's package is missing
    path = os.path.abspath(os.path.expanduser(str(default_file() if file is None else file)))
    if file is None and files.is_missing(path):
        return {}
    try:
        return parse(files.read(path))
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
    raise InvalidValue(f"the file {path} cannot be used: {reason}", "Fix it, or name another file.")


def resolve(typed: Dict[str, object]) -> Dict[str, object]:
    """Return all parameters: what is typed wins over the file ``config``, the file over the default.

    Without ``config``, the file is ``default_file``, which belongs to the real robot: a fake bus or port reads nothing
    from it. Raises InvalidValue.
    """
    typed = given(typed)
    config = typed.pop("config", None)
    file = {} if config is None and is_fake(typed) else load(config)
    return checked({**file, **typed})


def checked(values: Dict[str, object], parameters: Dict[str, Parameter] = PARAMETERS) -> Dict[str, object]:
    """Return all parameters: the values that are given, else the defaults. Raise InvalidValue for a bad value."""
    values = given(values)
    unknown = sorted(set(values) - set(parameters), key=str)
    if unknown:
        raise InvalidValue(f"there is no parameter {unknown[0]}", f"The parameters are {', '.join(parameters)}.")
    for name, row in parameters.items():
        if name in values and not row.kind.accepts(values[name]):
            raise InvalidValue(f"the parameter {name} must be {row.kind.description}, not {literal(values[name])}")
    return {name: values.get(name, row.default) for name, row in parameters.items()}


def given(values: Dict[str, object]) -> Dict[str, object]:
    """Return the values without those that are "", as a launch file passes on what was not typed."""
    return {name: value for name, value in values.items() if value != ""}


def is_fake(values: Dict[str, object]) -> bool:
    """Return whether these parameters name a fake bus, or a fake port for a board on a serial port."""
    place = values.get("i2c_bus" if BOARDS.get(str(values.get("board")), BOARDS["jetbot"]).address else "port", "")
    return bool(fake.folder_of(fake.expand(str(place))))
