"""A simulated JetBot Pro: takes frames, keeps the velocity they ask for, and reports its motion.

Its file holds the last velocity frame that it received, byte by byte as on the wire. Written from Waveshare's ROS node
for this robot, not from the driver.
"""

import math
import os
import struct
import time
from pathlib import Path

from . import chip_file

HEAD = b"\xaa\x55"
VELOCITY = 0x11
REPORT_INTERVAL = 1 / 30  # s


def sealed(body: bytes) -> bytes:
    """Return the frame with its checksum."""
    return body + bytes([sum(body) % 256])


class JetBotPro:
    """The board's side of the wire. velocities: (mm/s, mrad/s) of every velocity frame; bad: bytes that are no frame."""

    POWER_ON = sealed(HEAD + struct.pack(">BB3h", 11, VELOCITY, 0, 0, 0))

    def __init__(self):
        self.velocities = []
        self.bad = []
        self._buffer = b""

    def receive(self, data: bytes) -> bytes:
        """Take bytes from the computer; return the last velocity frame that they complete, b"" where they do not."""
        newest = b""
        self._buffer += data
        while len(self._buffer) > 2 and len(self._buffer) >= self._buffer[2] > 4:
            frame, self._buffer = self._buffer[:self._buffer[2]], self._buffer[self._buffer[2]:]
            if not frame.startswith(HEAD) or sealed(frame[:-1]) != frame:
                self.bad.append(frame)
            elif frame[3] == VELOCITY:
                newest = frame
                self.velocities.append(decode(frame))
        return newest

    @staticmethod
    def report(x: float, y: float, yaw: float, turn: float = 0.0) -> bytes:
        """Return a telemetry frame: x, y in mm, yaw in mrad, turn in rad/s; the numbers wrap as int16 do."""
        gyro = round(math.degrees(turn) / 2000 * 32768)
        pose = (wrap(round(value)) for value in (x, y, yaw))
        return sealed(HEAD + struct.pack(">BB6h6x3h16x", 45, 0x01, 0, 0, wrap(gyro), 0, 0, 16384, *pose))

    @staticmethod
    def speed(frame: bytes, side: int, silence: float = 0.0) -> float:
        """Return the speed of a wheel in m/s, for wheels 2 m apart. side: -1 left, 1 right."""
        linear, angular = decode(frame)
        return (linear + side * angular) / 1000


class FakePort:
    """Takes the place of ``serial.Serial``, with a JetBot Pro at the other end that drives as it is told.

    folder: made, with the board in it, when it does not exist; timeout: s that a read waits.
    """

    in_waiting = 0

    def __init__(self, folder, timeout: float):
        if not os.path.exists(folder):
            from .bus import power_on
            power_on(folder)
        self._file = chip_file(folder, None)
        self._timeout = timeout
        self._board = JetBotPro()
        self._pose = (0.0, 0.0, 0.0)  # mm, mm, mrad
        self._reported = time.monotonic()

    def write(self, data: bytes) -> None:
        frame = self._board.receive(data)
        with self._file.open("r+b") as file:  # FileNotFoundError: unplugged
            file.write(frame)

    def read(self, size: int) -> bytes:
        """Return the next telemetry frame, whatever the size asked for; b"" when none is due within the timeout."""
        time.sleep(min(self._timeout, max(0.0, self._reported + REPORT_INTERVAL - time.monotonic())))
        seconds = time.monotonic() - self._reported
        linear, angular = decode(self._file.read_bytes())
        if seconds < REPORT_INTERVAL:
            return b""
        self._reported += seconds
        x, y, yaw = self._pose
        heading = (yaw + angular * seconds / 2) / 1000
        way = linear * seconds
        self._pose = x + way * math.cos(heading), y + way * math.sin(heading), yaw + angular * seconds
        return self._board.report(*self._pose, angular / 1000)

    def close(self) -> None:
        """Nothing stays open between transfers."""


def decode(frame: bytes):
    """Return (mm/s, mrad/s) of a velocity frame."""
    linear, _, angular = struct.unpack_from(">3h", frame, 4)
    return linear, angular


def wrap(count: int) -> int:
    """Return the count as a signed 16-bit integer."""
    return (count + 0x8000) % 0x10000 - 0x8000
