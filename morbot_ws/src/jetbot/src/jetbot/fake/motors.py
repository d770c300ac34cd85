"""What the motors of a simulated robot do, by what its chip holds and how they are wired to that."""

import math
import os
import time
from typing import Optional, Tuple, Union

from ..boards import DEFAULT_PWM_FREQUENCY, find_board
from . import Folder, chip_file
from .chip_files import read_chip
from .chips import PCA9685, chip_class

STOPPED = (0.0, 0.0)  # speeds (left, right)
CLOCK_TICK = 0.05     # s, more than Linux's clock of files: of two writes within a tick, the second changes no time
# Adafruit, "Improve Low-Speed Performance of Brushed DC Motors": a gear motor (product 4416) starts at 1.4 V of 5 V at
# 1600 Hz, and at 0.1 V at 25 Hz.
STARTING_EXPONENT = math.log(1.4 / 0.1) / math.log(1600 / 25)


def dead_band_factor(pwm_frequency: float) -> float:
    """Return the duty at which a motor starts at a frequency in Hz, over that at DEFAULT_PWM_FREQUENCY."""
    return (pwm_frequency / DEFAULT_PWM_FREQUENCY) ** STARTING_EXPONENT


class Motors:
    """The motors of the robot with this board in a fake bus's folder. Its chip's file is read when it has changed.

    i2c_address: as for ``boards.find_board``.
    """

    def __init__(self, folder: Folder, board: str = "adafruit", i2c_address: Union[int, str, None] = None):
        self._board = find_board(board, i2c_address)
        self._chip = chip_class(self._board.chip)
        self._file = str(chip_file(folder, self._board.address))
        self._registers, self._written = b"", 0.0  # the time of the last write
        self._version: Optional[Tuple[int, ...]] = None  # of the file when it was read; None: read it again

    def speeds(self) -> Tuple[float, float]:
        """Return the speeds (left, right), 0 if there is no such chip."""
        self._read()
        if not self._registers:
            return STOPPED
        age = time.time() - self._written
        left, right = (self._chip.speed(self._registers, motor, age) for motor in (self._board.left, self._board.right))
        return left, right

    def pwm_frequency(self) -> Optional[float]:
        """Return the frequency of the PWM in Hz; None where it is fixed, or without a chip."""
        self._read()
        return PCA9685.frequency(self._registers) if self._registers and self._chip is PCA9685 else None

    def _read(self) -> None:
        try:
            status = os.stat(self._file)
            version = status.st_mtime_ns, status.st_ino, status.st_size
            if version == self._version:
                return
            chip, registers, self._written = read_chip(self._file, self._board.address)
            self._registers = registers if chip is self._chip else b""
            self._version = version if time.time() - status.st_mtime > CLOCK_TICK else None
        except OSError:  # a BusError, too; the controller reports it
            self._registers, self._version = b"", None


def wheel_speeds(folder: Folder, board: str = "adafruit",
                 i2c_address: Union[int, str, None] = None) -> Tuple[float, float]:
    """Return the ``speeds`` of the robot's motors. Parameters: as for ``Motors``."""
    return Motors(folder, board, i2c_address).speeds()
