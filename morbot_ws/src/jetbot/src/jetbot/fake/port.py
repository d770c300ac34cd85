"""A serial port without hardware, with a simulated JetBot Pro at the other end, which is a file in a folder."""

import math
import os
import time

from . import Folder, chip_file
from .bus import power_on
from .chip_files import read_chip
from .chips import JetBotPro, decode

TELEMETRY_INTERVAL = 1 / 30  # s


class FakePort:
    """Takes the place of ``serial.Serial``, with a JetBot Pro at the other end that drives as commanded.

    folder: made, with the board in it, if it does not exist; timeout: s that a read waits.
    """

    in_waiting = 0

    def __init__(self, folder: Folder, timeout: float):
        if not os.path.exists(folder):
            power_on(folder)
        self._file = str(chip_file(folder, None))
        self._timeout = timeout
        self._board = JetBotPro()
        self._pose = (0.0, 0.0, 0.0)  # mm, mm, mrad
        self._sent_at = time.monotonic()

    def write(self, data: bytes) -> None:
        frame = self._board.receive(data)
        read_chip(self._file, None)  # FileNotFoundError: unplugged
        with open(self._file, "r+b", buffering=0) as chip:
            chip.write(frame)

    def read(self, size: int) -> bytes:
        """Return the next telemetry frame, whatever the size asked for; b"" when none is due within the timeout."""
        time.sleep(min(self._timeout, max(0.0, self._sent_at + TELEMETRY_INTERVAL - time.monotonic())))
        seconds = time.monotonic() - self._sent_at
        linear, angular = decode(read_chip(self._file, None)[1])
        if seconds < TELEMETRY_INTERVAL:
            return b""
        self._sent_at += seconds
        x, y, yaw = self._pose
        heading = (yaw + angular * seconds / 2) / 1000
        way = linear * seconds
        self._pose = x + way * math.cos(heading), y + way * math.sin(heading), yaw + angular * seconds
        return self._board.telemetry(*self._pose, angular / 1000)

    def close(self) -> None:
        """Nothing stays open between transfers."""
