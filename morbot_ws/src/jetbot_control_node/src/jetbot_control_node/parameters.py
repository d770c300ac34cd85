"""The parameters. A parameter is one row, for the node, the launch file, YAML comments, command lines and the docs."""

import os
from pathlib import Path
from typing import Collection, Dict, Optional, Union

from jetbot import InvalidValue, fake, files
from jetbot.boards import BOARDS, DEFAULT_PORT, DEFAULT_PWM_FREQUENCY, SERIAL_BOARD, find_board
from jetbot.host import ros_home
from jetbot.kinds import (
    ADDRESS,
    BOOLEAN,
    DUTY,
    FRACTION,
    NON_NEGATIVE,
    NUMBER,
    POSITIVE,
    PWM_FREQUENCY,
    SECONDS,
    Kind,
    check_duties,
)
from jetbot.text import enumeration
from jetbot_ros.node_parameters import Parameter, check_values, given

SHIPPED = files.shipped(__file__, "jetbot_control_node", "config")
MAX_BUS = 2**20 - 1  # Linux's minor numbers have 20 bits


# A list: what a YAML file gives may not be hashable.
BOARD = Kind(lambda value: value in list(BOARDS), f"one of {', '.join(BOARDS)}")
BUS = Kind(lambda value: isinstance(value, str) or type(value) is int and 0 <= value <= MAX_BUS,
           "a number, fake, or fake:FOLDER")
SERIAL = Kind(lambda value: isinstance(value, str), "a serial device, a socket:// URL, fake, or fake:FOLDER")

PARAMETERS = {
    "board": Parameter("jetbot", BOARD, f"motor board, one of {', '.join(BOARDS)}; jetbot is Adafruit's and "
                                        "Waveshare's layout at once"),
    "i2c_bus": Parameter(1, BUS, "I2C bus: N for /dev/i2c-N, fake (no robot needed), or fake:FOLDER"),
    "i2c_address": Parameter(None, ADDRESS, "I2C address of the board with its 0x, as 0x61, where jumpers or "
                                            "switches change it"),
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
    "max_duty": Parameter(1.0, DUTY, "largest duty, at speed 1; below 1 it limits the speed, and the robot still "
                                      "steers"),
    "acceleration_limit": Parameter(0.0, NON_NEGATIVE, "largest increase of a wheel's speed per second; 0: no limit. "
                                                       "Stops are immediate", "m/s^2"),
    "pwm_frequency": Parameter(DEFAULT_PWM_FREQUENCY, PWM_FREQUENCY, "frequency of the PWM of a PCA9685, 24 to 1526; "
                               "motors start at a lower duty where it is low", "Hz"),
    "publish_odom": Parameter(False, BOOLEAN, "true: a board that measures nothing publishes odom and joint_states "
                                              "from what the wheels are given"),
    "publish_tf": Parameter(False, BOOLEAN, "true: the node that publishes odom also publishes tf "
                                            "odom -> base_footprint"),
}


def default_file() -> Path:
    """Return the file that keeps the parameters of this computer's robot: jetbot.yaml in ROS's home (~/.ros)."""
    return ros_home() / "jetbot.yaml"


def load(file: Union[str, Path]) -> Dict[str, object]:
    """Return the parameters in a YAML file; raise InvalidValue if it cannot be read or holds something else."""
    import yaml  # here: doctor.py reports that it is missing
    try:
        values = yaml.safe_load(files.read(file))
        reason = content_problem(values)
    except yaml.MarkedYAMLError as error:
        reason = f"line {error.problem_mark.line + 1}: {error.problem}"
    except (OSError, ValueError, OverflowError, RecursionError, yaml.YAMLError) as error:
        reason = getattr(error, "strerror", None) or str(error).partition("\n")[0]
    if reason:
        raise InvalidValue(f"the file {file} cannot be used: {reason.rstrip('.')}",
                           "Fix it, or name another file by its whole path.")
    return values


def content_problem(values: object) -> Optional[str]:
    """Return the problem of what a YAML file holds, or None if each name has one plain value."""
    if not (isinstance(values, dict) and values):
        return "it holds no parameters"
    for name, value in values.items():
        if value in ("", None) or isinstance(value, (list, dict)):  # which aliases may make too large to print
            return f"it must give {name} one value"
    return None


def resolve(typed: Dict[str, object]) -> Dict[str, object]:
    """Return all parameters, and as ``config`` the path of the file that was read, or "".

    What is typed wins over the file, the file over the default. Without a typed ``config``, the file is
    ``default_file``; not with a typed fake bus or port, because that file is the real robot's. Raises InvalidValue.
    """
    typed = given(typed)
    simulated = [name for name in ("i2c_bus", "port") if is_fake_place(typed.get(name))]
    file = find_file(typed.pop("config", ""), simulated)
    values = load(file) if file else {}
    if simulated == ["port"]:
        values.setdefault("board", SERIAL_BOARD)
    values = checked({**values, **typed})
    place = place_of(values["board"])
    if simulated and place not in typed and not is_fake(values):  # else the real robot would drive
        raise InvalidValue(f"the {simulated[0]} is fake, but the board {values['board']} is on the {place} "
                           f"{values[place]}", option=place)
    return {**values, "config": file}


def find_file(config: object, simulated: Collection[str]) -> str:
    """Return the absolute path of the file to read, or "". config: what is typed; simulated: what is typed as fake.

    A name such as si_units.yaml, if there is no such file, is one of this package's. Raise InvalidValue if it is not.
    """
    if config == "":
        return "" if simulated or not os.path.lexists(default_file()) else os.path.abspath(default_file())
    file = os.path.abspath(os.path.expanduser(str(config)))
    shipped = SHIPPED / str(config)
    if os.path.lexists(file):
        return file
    if not shipped.is_file():
        raise InvalidValue(f"there is no file {file}", "Name a file of your own by its whole path; this package has "
                                                       f"{enumeration(sorted(os.listdir(SHIPPED)))}.")
    return str(shipped)


def checked(values: Dict[str, object]) -> Dict[str, object]:
    """Return all parameters: the values that are given, else the defaults. Raise InvalidValue for a bad value."""
    values = check_values(values, PARAMETERS)
    check_duties(values["min_duty"], values["max_duty"])
    return values


def place_of(board: str) -> str:
    """Return which parameter names the place of a board: i2c_bus or port."""
    return "i2c_bus" if find_board(board).address else "port"


def is_fake(values: Dict[str, object]) -> bool:
    """Return whether the board in these parameters is on a fake bus or port."""
    return is_fake_place(values.get(place_of(values["board"])))


def is_fake_place(place: object) -> bool:
    """Return whether this names a fake bus or port."""
    return bool(fake.folder_of(fake.expand(str(place))))
