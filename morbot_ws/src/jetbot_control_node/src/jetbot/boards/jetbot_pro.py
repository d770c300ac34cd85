"""Waveshare's JetBot ROS AI Kit, "JetBot Pro": a board of its own computer, driven by frames over a serial port.

A frame is AA 55, the number of all its bytes, a type, the payload (big-endian), and the sum of the rest modulo 256.
Numbers and units are those of Waveshare's own ROS node for this robot, package jetbot_pro.
"""

import math
import struct
import threading
import time
from typing import NamedTuple, Tuple

from ..errors import BusError

HEAD = b"\xaa\x55"
VELOCITY, PID, CORRECTIONS = 0x11, 0x12, 0x13   # to the board
TELEMETRY, TELEMETRY_PAYLOAD = 0x01, 40         # from the board: type, bytes
SHORTEST, LONGEST = 5, 64                       # bytes of a frame
VENDORS_PID = (350, 120, 0)                     # of the board's own control of the wheels' speeds
NO_CORRECTIONS = (1000, 1000)                   # thousandths: linear, angular

GYRO_SCALE = math.radians(2000) / 32768         # rad/s: an int16 for the range of 2000 deg/s
ACCELERATION_SCALE = 2 * 9.80665 / 32768        # m/s^2: an int16 for the range of 2 g


class Telemetry(NamedTuple):
    """What the board tells of itself; axes ahead, to the left and up. Position and yaw count from its start."""

    gyro: Tuple[float, float, float]          # rad/s
    acceleration: Tuple[float, float, float]  # m/s^2
    x: float    # m
    y: float    # m
    yaw: float  # rad, to the left


class JetBotPro:
    """Drives the board, which controls the speeds of its wheels itself.

    Speeds (left, right) are sent as vx = (left + right) / 2 and wz = (right - left) / 2: with the controller's default
    mixing, a Twist reaches the board unchanged, in m/s and rad/s. link: a SerialLink; options are not needed.
    """

    def __init__(self, link, options):
        self.link = link
        self._sent = None
        self._closed = False
        self._listener = None

    def start(self):
        """Set the board up with both wheels off."""
        self.link.write(frame(PID, *VENDORS_PID) + frame(CORRECTIONS, *NO_CORRECTIONS))
        self._send(velocity(0, 0))

    def drive(self, left, right):
        """Turn the wheels at these speeds, in [-1, 1]."""
        if self._sent is None:
            self.start()
        wanted = velocity(left, right)
        if wanted != self._sent:
            self._send(wanted)

    def refresh(self, left, right, idle):
        """Drive as before, and say so again."""
        if idle and self._sent is not None:
            self._send(self._sent)
        self.drive(left, right)

    def listen(self, callback):
        """Call back with each Telemetry from now on, from a thread of its own. The callback must not raise."""
        self._listener = threading.Thread(target=self._listen, args=[callback], daemon=True)
        self._listener.start()

    def close(self):
        """Let go of the port."""
        self._closed = True
        if self._listener not in (None, threading.current_thread()):
            self._listener.join(1.0)  # its next read would open the port again
        self.link.close()

    def _send(self, wanted):
        self._sent = None  # until it went through
        self.link.write(wanted)
        self._sent = wanted

    def _listen(self, callback):
        reader = FrameReader()
        while not self._closed:
            try:
                received = self.link.read()
            except BusError:
                time.sleep(0.1)  # whoever drives reports it
                continue
            for report in reports(reader.feed(received)):
                callback(report)


class FrameReader:
    """Finds frames in a stream of bytes, past noise, lost bytes and wrong sums."""

    def __init__(self):
        self._buffer = b""

    def feed(self, data):
        """Yield (type, payload) for every whole frame that the new bytes complete."""
        self._buffer += data
        while True:
            start = self._buffer.find(HEAD)
            self._buffer = self._buffer[start:] if start >= 0 else self._buffer[-1:]
            length = self._buffer[2] if len(self._buffer) > 2 else LONGEST
            if len(self._buffer) < length and length <= LONGEST:
                return
            candidate = self._buffer[:length]
            if SHORTEST <= length <= LONGEST and checksum(candidate[:-1]) == candidate[-1]:
                self._buffer = self._buffer[length:]
                yield candidate[3], candidate[4:-1]
            else:
                self._buffer = self._buffer[1:]


def frame(kind, *values):
    """A frame of this type with int16 values."""
    body = HEAD + bytes([SHORTEST + 2 * len(values), kind]) + struct.pack(f">{len(values)}h", *values)
    return body + bytes([checksum(body)])


def checksum(data):
    return sum(data) % 256


def velocity(left, right):
    """The frame for these wheel speeds: vx in mm/s, vy = 0, wz in mrad/s."""
    return frame(VELOCITY, round(500 * (left + right)), 0, round(500 * (right - left)))


def reports(frames):
    """The Telemetry in frames of (type, payload), of which others may be among them."""
    return (telemetry(payload) for kind, payload in frames
            if kind == TELEMETRY and len(payload) == TELEMETRY_PAYLOAD)


def telemetry(payload):
    """The Telemetry in a payload: the frame's bytes 4.. gyro, 10.. acceleration, 22.. x, y (mm), yaw (mrad)."""
    motion = struct.unpack_from(">6h", payload, 0)
    x, y, yaw = struct.unpack_from(">3h", payload, 22 - 4)
    return Telemetry(tuple(GYRO_SCALE * value for value in motion[:3]),
                     tuple(ACCELERATION_SCALE * value for value in motion[3:]), x / 1000, y / 1000, yaw / 1000)
