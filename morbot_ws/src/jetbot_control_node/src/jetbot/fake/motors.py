"""The robots that can be simulated. A robot is a row of ROBOTS: its chip, and how its motors are wired to it.

Written from the boards' circuit diagrams and not from ``boards``, so that a driver's mistake shows.
"""

import time
from typing import NamedTuple, Optional, Tuple, Union

from ..errors import BusError
from ..kinds import address_of
from . import Folder, chip_file
from .chips import PCA9685, SCMD
from .files import read_chip
from .jetbot_pro import JetBotPro

STOPPED = (0.0, 0.0)  # speeds (left, right)


class FakeRobot(NamedTuple):
    """A row of ROBOTS. left, right: how each motor is wired to the chip, as the chip's ``speed`` takes it."""

    chip: type
    address: Optional[int]  # None: a board on the serial port
    left: object
    right: object
    closed_loop: bool = False  # the board controls its wheel speeds, which are in m/s for wheels 2 m apart


ROBOTS = {
    "adafruit": FakeRobot(PCA9685, 0x60, left=(8, 9, 10), right=(13, 12, 11)),
    "waveshare": FakeRobot(PCA9685, 0x60, left=(None, 1, 0), right=(None, 2, 3)),
    "waveshare_hat": FakeRobot(PCA9685, 0x40, left=(0, 2, 1), right=(5, 4, 3)),
    "sparkfun": FakeRobot(SCMD, 0x5D, left=0x20, right=0x21),
    "jetbot_pro": FakeRobot(JetBotPro, None, left=-1, right=1, closed_loop=True),
}
ROBOTS["jetbot"] = ROBOTS["adafruit"]  # the driver `jetbot` serves both layouts; this robot has one


def wheel_speeds(folder: Folder, board: str = "adafruit",
                 i2c_address: Union[int, str, None] = None) -> Tuple[float, float]:
    """Return the speeds (left, right) of the robot with this board in a fake bus's folder; 0 if there is no chip.

    i2c_address: as for ``boards.find_board``.
    """
    robot = ROBOTS[board]
    registers, written = read_robot(folder, robot, i2c_address)
    if registers is None:
        return STOPPED
    age = time.time() - written
    return robot.chip.speed(registers, robot.left, age), robot.chip.speed(registers, robot.right, age)


def pwm_frequency(folder: Folder, board: str = "adafruit",
                  i2c_address: Union[int, str, None] = None) -> Optional[float]:
    """Return the frequency in Hz of the PWM of the robot with this board; None where it is fixed, or without a chip."""
    robot = ROBOTS[board]
    registers, _ = read_robot(folder, robot, i2c_address)
    return PCA9685.frequency(registers) if registers and robot.chip is PCA9685 else None


def read_robot(folder: Folder, robot: FakeRobot, i2c_address: Union[int, str, None]) -> Tuple[Optional[bytes], float]:
    """Return the registers of a robot's chip and the time of the last write to it; None, 0 if there is no chip."""
    address = address_of(i2c_address) if i2c_address and robot.address else robot.address
    try:
        return read_chip(chip_file(folder, address), len(robot.chip.POWER_ON))
    except (FileNotFoundError, BusError):
        return None, 0.0
