"""A simulated JetBot Pro: takes velocity frames, and sends telemetry.

Its registers are the last velocity frame that it received, byte by byte as on the wire. Written from Waveshare's ROS
node for this robot, not from the driver.
"""

import math
import struct
from collections import deque
from typing import Tuple

HEADER = b"\xaa\x55"
VELOCITY = 0x11


def with_checksum(body: bytes) -> bytes:
    """Return the frame with its checksum."""
    return body + bytes([sum(body) % 256])


class JetBotPro:
    """The board's end of the wire. velocities: (mm/s, mrad/s) of the last velocity frames; bad: what was no frame."""

    POWER_ON = with_checksum(HEADER + struct.pack(">BB3h", 11, VELOCITY, 0, 0, 0))

    def __init__(self):
        self.velocities = deque(maxlen=1000)
        self.bad = deque(maxlen=1000)
        self._buffer = b""

    def receive(self, data: bytes) -> bytes:
        """Take bytes from the computer; return the last velocity frame that they complete, or b""."""
        newest = b""
        self._buffer += data
        while len(self._buffer) > 2:
            length = self._buffer[2] if self._buffer.startswith(HEADER) else 1  # what begins no frame is skipped
            if len(self._buffer) < length:
                break
            frame, self._buffer = self._buffer[:max(1, length)], self._buffer[max(1, length):]
            if len(frame) < 5 or with_checksum(frame[:-1]) != frame:
                self.bad.append(frame)
            elif frame[3] == VELOCITY:
                newest = frame
                self.velocities.append(decode(frame))
        return newest

    @staticmethod
    def telemetry(x: float, y: float, yaw: float, turn: float = 0.0) -> bytes:
        """Return a telemetry frame: x, y in mm, yaw in mrad, turn in rad/s; the numbers wrap as int16 do."""
        gyro = round(math.degrees(turn) / 2000 * 32768)
        pose = (wrap(round(value)) for value in (x, y, yaw))
        return with_checksum(HEADER + struct.pack(">BB6h6x3h16x", 45, 0x01, 0, 0, wrap(gyro), 0, 0, 16384, *pose))

    @staticmethod
    def speed(frame: bytes, side: int, age: float = 0.0) -> float:
        """Return the speed of a wheel in m/s, for wheels 2 m apart. side: -1 left, 1 right."""
        linear, angular = decode(frame)
        return (linear + side * angular) / 1000


def decode(frame: bytes) -> Tuple[int, int]:
    """Return (mm/s, mrad/s) of a velocity frame."""
    linear, _, angular = struct.unpack_from(">3h", frame, 4)
    return linear, angular


def wrap(count: int) -> int:
    """Return the count as a signed 16-bit integer."""
    return (count + 0x8000) % 0x10000 - 0x8000
