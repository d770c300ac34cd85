"""Waveshare's JetBot ROS AI Kit, "JetBot Pro": a board with a computer of its own, driven over a serial port.

A frame is AA 55, its length in bytes, a type, the payload (big-endian), and the sum of all these bytes modulo 256.
Numbers and units are those of Waveshare's own ROS node for this robot, https://github.com/waveshare/jetbot_pro.
"""

import math
import struct
import threading
import time
from typing import Any, Callable, Iterator, Optional, Tuple

from ..errors import BusError
from .driver import Link, MotorDriver, Telemetry

HEADER = b"\xaa\x55"
MIN_FRAME, MAX_FRAME = 5, 64                    # bytes; the longest that the board sends, telemetry, has 45
VELOCITY, PID, CORRECTIONS = 0x11, 0x12, 0x13   # types of frames to the board
TELEMETRY, TELEMETRY_PAYLOAD = 0x01, 40         # from the board: type, bytes
DEFAULT_PID_GAINS = (350, 120, 0)               # of the board's own control of its wheel speeds
NO_CORRECTIONS = (1000, 1000)                   # thousandths: linear, angular
INT16_MAX = 32767
PADDING = bytes(10)                             # completes a frame that was cut; zeros, so that a false one is tame

GYRO_SCALE = math.radians(2000) / 32768         # rad/s: an int16 for the range of 2000 deg/s
ACCELERATION_SCALE = 2 * 9.80665 / 32768        # m/s^2: an int16 for the range of 2 g
RETRY_INTERVAL = 0.1                            # s until a failed read is tried again


class JetBotPro(MotorDriver):
    """Drives the board, which limits and controls the speeds of its wheels itself.

    Speeds (left, right) are sent as vx = (left + right) / 2 and wz = (right - left) / 2: with the workshop's mixing, a
    Twist reaches the board unchanged, in m/s and rad/s.
    """

    limit = INT16_MAX / 1000  # the frame's numbers are int16, in mm/s and mrad/s
    resolution = 0.001
    closed_loop = True
    ignores = ("wheel_separation", "max_speed", "left_motor_alpha", "right_motor_alpha", "min_duty", "max_duty",
               "pwm_frequency", "publish_odom")
    keep_alive_interval = 0.04  # s; so a lost frame is soon repeated

    def __init__(self, link: Link, *settings: Any):
        super().__init__(link, *settings)
        self._sent: Optional[bytes] = None
        self._closed = False
        self._listener: Optional[threading.Thread] = None

    @property
    def in_sync(self) -> bool:
        return self._sent is not None

    def start(self) -> None:
        self.link.write(frame(PID, *DEFAULT_PID_GAINS) + frame(CORRECTIONS, *NO_CORRECTIONS))
        self._send(velocity(0, 0))

    def drive(self, left: float, right: float) -> None:
        if self._sent is None:
            self.link.write(PADDING)
            self.start()
        wanted = velocity(left, right)
        if wanted != self._sent:
            self._send(wanted)

    def invalidate(self) -> None:
        self._sent = None

    def keep_alive(self) -> None:
        if self._sent is not None:
            self._send(self._sent)

    def listen(self, callback: Callable[[Telemetry], None]) -> None:
        self._listener = threading.Thread(target=self._listen, args=[callback], daemon=True)
        self._listener.start()

    def close(self) -> None:
        self._closed = True
        if self._listener not in (None, threading.current_thread()):
            self._listener.join(1.0)  # its next read would open the port again
        self.link.close()

    def _send(self, wanted: bytes) -> None:
        self._sent = None  # until it went through
        self.link.write(wanted)
        self._sent = wanted

    def _listen(self, callback: Callable[[Telemetry], None]) -> None:
        reader = FrameReader()
        while not self._closed:
            try:
                received = self.link.read()
            except BusError:
                time.sleep(RETRY_INTERVAL)  # the thread that drives reports it
                continue
            for telemetry in reader.telemetry(received):
                callback(telemetry)


class FrameReader:
    """Finds frames in a stream of bytes, past noise, lost bytes and wrong sums."""

    def __init__(self) -> None:
        self._buffer = b""

    def feed(self, data: bytes) -> Iterator[Tuple[int, bytes]]:
        """Yield (type, payload) for every frame that the new bytes complete."""
        self._buffer += data
        while True:
            start = self._buffer.find(HEADER)
            self._buffer = self._buffer[start:] if start >= 0 else self._buffer[-1:]
            length = self._buffer[2] if len(self._buffer) > 2 else MAX_FRAME
            if len(self._buffer) < length <= MAX_FRAME:
                return
            candidate = self._buffer[:length]
            if MIN_FRAME <= length <= MAX_FRAME and checksum(candidate[:-1]) == candidate[-1]:
                self._buffer = self._buffer[length:]
                yield candidate[3], candidate[4:-1]
            else:
                self._buffer = self._buffer[1:]

    def telemetry(self, data: bytes) -> Iterator[Telemetry]:
        """Yield every Telemetry that the new bytes complete."""
        for kind, payload in self.feed(data):
            if kind == TELEMETRY and len(payload) == TELEMETRY_PAYLOAD:
                yield decode_telemetry(payload)


def frame(kind: int, *values: int) -> bytes:
    """Return a frame of this type with int16 values."""
    body = HEADER + bytes([MIN_FRAME + 2 * len(values), kind]) + struct.pack(f">{len(values)}h", *values)
    return body + bytes([checksum(body)])


def checksum(data: bytes) -> int:
    """Return the last byte of a frame whose other bytes are ``data``."""
    return sum(data) % 256


def velocity(left: float, right: float) -> bytes:
    """Return the frame for these wheel speeds: vx in mm/s, vy = 0, wz in mrad/s."""
    return frame(VELOCITY, round(500 * (left + right)), 0, round(500 * (right - left)))


def decode_telemetry(payload: bytes) -> Telemetry:
    """Return the Telemetry in a payload: the frame's bytes 4.. gyro, 10.. acceleration, 22.. x, y, yaw."""
    motion = struct.unpack_from(">6h", payload, 0)
    return Telemetry(tuple(GYRO_SCALE * value for value in motion[:3]),
                     tuple(ACCELERATION_SCALE * value for value in motion[3:]),
                     *struct.unpack_from(">3h", payload, 22 - 4))
