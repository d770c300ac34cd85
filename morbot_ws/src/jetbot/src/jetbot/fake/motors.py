"""The robots that can be simulated. A robot is a row of ROBOTS: its chip, and how its motors are wired to it.

Written from the boards' circuit diagrams and not from ``boards``, so that a driver's mistake shows.
"""

import os
import time
from typing import NamedTuple, Optional, Tuple, Union

from ..errors import BusError
from ..kinds import address_of
from . import Folder, chip_file
from .chips import PCA9685, SCMD
from .files import read_chip
from .jetbot_pro import JetBotPro

STOPPED = (0.0, 0.0)  # speeds (left, right)
CLOCK_TICK = 0.05     # s, more than Linux's clock of files: of two writes within a tick, the second changes no time


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


class Motors:
    """The motors of the robot with this board in a fake bus's folder. Its chip's file is read when it has changed.

    i2c_address: as for ``boards.find_board``.
    """

    def __init__(self, folder: Folder, board: str = "adafruit", i2c_address: Union[int, str, None] = None):
        self._robot = robot = ROBOTS[board]
        self._file = str(chip_file(folder, address_of(i2c_address) if i2c_address and robot.address else robot.address))
        self._registers, self._written = None, 0.0  # the time of the last write
        self._version = None  # of the file when it was read; None: read it again

    def speeds(self) -> Tuple[float, float]:
        """Return the speeds (left, right), 0 if there is no chip."""
        self._read()
        if self._registers is None:
            return STOPPED
        age, chip = time.time() - self._written, self._robot.chip
        return chip.speed(self._registers, self._robot.left, age), chip.speed(self._registers, self._robot.right, age)

    def pwm_frequency(self) -> Optional[float]:
        """Return the frequency of the PWM in Hz; None where it is fixed, or without a chip."""
        self._read()
        return PCA9685.frequency(self._registers) if self._registers and self._robot.chip is PCA9685 else None

    def _read(self):
        try:
            status = os.stat(self._file)
            version = status.st_mtime_ns, status.st_ino, status.st_size
            if version == self._version:
                return
            self._registers, self._written = read_chip(self._file, len(self._robot.chip.POWER_ON))
            self._version = version if time.time() - status.st_mtime > CLOCK_TICK else None
        except (FileNotFoundError, BusError):
            self._registers = self._version = None


def wheel_speeds(folder: Folder, board: str = "adafruit",
                 i2c_address: Union[int, str, None] = None) -> Tuple[float, float]:
    """Return the ``speeds`` of the robot's motors. Parameters: as for ``Motors``."""
    return Motors(folder, board, i2c_address).speeds()


def pwm_frequency(folder: Folder, board: str = "adafruit",
                  i2c_address: Union[int, str, None] = None) -> Optional[float]:
    """Return the ``pwm_frequency`` of the robot's motors. Parameters: as for ``Motors``."""
    return Motors(folder, board, i2c_address).pwm_frequency()
