"""SparkFun's Serial Controlled Motor Driver: two motors, and a timer that stops them when the computer hangs.

Registers and bits by the names of SparkFun's firmware, https://github.com/sparkfun/Serial_Controlled_Motor_Driver.
"""

import itertools
from typing import Any, Optional

from ..errors import NoAnswer, NotReady
from .driver import Link, MotorDriver

ID = 0x01
ID_WORD = 0xA9
FSAFE_CTRL = 0x1F
FSAFE_DRIVE_KILL = 0x01          # what the failsafe does: stop the motors
MA_DRIVE, MB_DRIVE = 0x20, 0x21  # the left and the right motor
DRIVER_ENABLE = 0x70             # 0 at power-on
FSAFE_TIME = 0x76                # units of 10 ms without a transfer; 0: off
STATUS_1 = 0x77
ENUMERATION_BIT = 0x01           # 0 while the firmware looks for further boards

STOP = 0x80
STOPPED = bytes([STOP, STOP])
TIMEOUT = 100                    # FSAFE_TIME while the timer is fed: 1.0 s


class ScmdMotors(MotorDriver):
    """Drives the SCMD. Its timer is off until the first ``keep_alive``; from then on it must be fed within 1.0 s."""

    resolution = 1 / 0x80
    ignores = ("pwm_frequency",)
    chip_name = "SparkFun motor driver"
    stretches_clock = True

    def __init__(self, link: Link, *settings: Any):
        super().__init__(link, *settings)
        self._sent: Optional[bytes] = None  # the drive bytes as the chip holds them; None: not known
        self._timeout = 0  # FSAFE_TIME as the chip holds it
        self._verified = itertools.cycle([DRIVER_ENABLE, MA_DRIVE, FSAFE_CTRL, MB_DRIVE, FSAFE_TIME])
        self._differs = False  # whether something else was read than was sent

    @staticmethod
    def recognizes(link: Link) -> bool:
        return link.read(ID) == ID_WORD

    @property
    def in_sync(self) -> bool:
        return self._sent is not None

    def start(self) -> None:
        if not self.recognizes(self.link):
            raise NoAnswer(f"the chip at 0x{self.link.address:02x} on {self.link.name} is not a {self.chip_name}",
                           "Choose another board.")
        self._sent = None  # until all of it went through
        self._count_fault()
        self.link.write(DRIVER_ENABLE, [0])
        if not self.link.read(STATUS_1) & ENUMERATION_BIT:
            raise NotReady(f"the motor driver on {self.link.name} is not ready", "Switch the robot off and on.")
        self._write_speeds(STOPPED)
        self.link.write(FSAFE_CTRL, [FSAFE_DRIVE_KILL])
        self._feed(0)
        self.link.write(DRIVER_ENABLE, [1])
        self._sent = STOPPED

    def drive(self, left: float, right: float) -> None:
        if self._sent is None:
            self.start()
        wanted = bytes([encode(left), encode(right)])
        if wanted != self._sent:
            self._send(wanted)

    def verify(self) -> None:
        sent, self._sent = self._sent, None  # also if the chip does not answer
        if sent is None:
            return
        register = next(self._verified)
        expected = {DRIVER_ENABLE: 1, FSAFE_CTRL: FSAFE_DRIVE_KILL, FSAFE_TIME: self._timeout,
                    MA_DRIVE: sent[0], MB_DRIVE: sent[1]}
        if self.link.read(register) == expected[register]:
            self._sent = sent
        else:
            self._differs = True

    def invalidate(self) -> None:
        self._sent = None

    def keep_alive(self) -> None:
        sent, self._sent = self._sent, None  # until all of it went through
        if sent is None:
            return
        if self.link.read(DRIVER_ENABLE):
            self._feed(TIMEOUT)
            self._send(sent)  # whatever another program has written there
        else:
            self._differs = True  # a brown-out: what follows would hide it from ``verify``

    def _feed(self, timeout: int) -> None:
        self.link.write(FSAFE_TIME, [timeout])
        self._timeout = timeout

    def _count_fault(self) -> None:
        """Count why the board was found changed: only a power-on leaves its motors disabled."""
        if self._differs:
            if self.link.read(DRIVER_ENABLE):
                self.overwritten += 1
            else:
                self.resets += 1
        self._differs = False

    def _send(self, wanted: bytes) -> None:
        self._sent = None  # until all of it went through
        self._write_speeds(wanted)
        self._sent = wanted

    def _write_speeds(self, speeds: bytes) -> None:
        self.link.write(MA_DRIVE, speeds[:1])  # one by one: whether a board takes both depends on its firmware
        self.link.write(MB_DRIVE, speeds[1:])


def encode(speed: float) -> int:
    """Return the drive byte for a speed in [-1, 1]: forward counts down from STOP, as the JetBot's motors are wired.

    Full backward would be 256, which a byte wraps to 0, full forward; 255 is as near as it gets.
    """
    return min(0xFF, STOP - round(speed * 0x80))
