"""SparkFun's Serial Controlled Motor Driver: two motors, and a timer that stops them when the computer hangs.

Registers as in SparkFun's firmware, https://github.com/sparkfun/Serial_Controlled_Motor_Driver.
"""

import time

from ..errors import BusError

ID = 0x01
ID_WORD = 0xA9
FAILSAFE_CONTROL = 0x1F
STOP_MOTORS = 0x01      # what the failsafe does when its time has run out
LEFT, RIGHT = 0x20, 0x21
DRIVER_ENABLE = 0x70    # 0 at power-on
FAILSAFE_TIME = 0x76    # units of 10 ms without a transfer; 0: off
STATUS_1 = 0x77
READY = 0x01
START_UP = 2.0          # seconds; the firmware looks for further boards first


class ScmdMotors:
    """Drives the SCMD. Every idle refresh is a transfer, and so keeps its failsafe from stopping the wheels.

    link: an I2CDevice; options.failsafe: 0.1 to 2.55 s, to which other times are brought, or 0 for none.
    """

    def __init__(self, link, options):
        self.link = link
        self._failsafe = failsafe_time(options.failsafe)
        self._sent = None  # the drive bytes as the chip holds them; None: not known
        self._blocks = False

    def start(self, patience=START_UP):
        """Set the chip up with both wheels off; ``patience``: seconds that it may take to become ready."""
        if self.link.read(ID) != ID_WORD:
            raise BusError(f"at 0x{self.link.address:02x} on {self.link.name} is no SparkFun motor driver",
                           "Something else answers there: choose another board.")
        self._wait_until_ready(patience)
        self.link.write(DRIVER_ENABLE, [0])
        self._blocks = self._takes_blocks()
        self._send(bytes([encode(0), encode(0)]))
        self.link.write(FAILSAFE_CONTROL, [STOP_MOTORS])
        self.link.write(FAILSAFE_TIME, [self._failsafe])
        self.link.write(DRIVER_ENABLE, [1])

    def drive(self, left, right):
        """Turn the wheels at these speeds, in [-1, 1]."""
        if self._sent is None:
            self.start(patience=0)  # a program that drives has no time to wait, and tries again
        wanted = bytes([encode(left), encode(right)])
        if wanted != self._sent:
            self._send(wanted)

    def refresh(self, left, right, idle):
        """Drive as before, when idle with a transfer; set a chip up again that lost its power meanwhile."""
        sent = self._sent
        if idle and sent is not None:
            self._sent = None
            if self.link.read(DRIVER_ENABLE) & 1:
                self._send(sent)
        self.drive(left, right)

    def close(self):
        """Let go of the bus; the wheels go on until the failsafe stops them."""
        self.link.close()

    def _wait_until_ready(self, patience):
        deadline = time.monotonic() + patience
        while not self.link.read(STATUS_1) & READY:
            if time.monotonic() > deadline:
                raise BusError(f"the motor driver on {self.link.name} is not ready",
                               "Switch the robot off and on.")
            time.sleep(0.01)

    def _takes_blocks(self):
        """Whether both drive bytes arrive in one transfer; tried with the motors switched off."""
        try:
            self.link.write(LEFT, [encode(0), encode(0) - 1])
        except BusError:  # it refuses blocks; where it is gone, the next transfer tells
            return False
        return self.link.read(RIGHT) == encode(0) - 1

    def _send(self, wanted):
        self._sent = None  # until all of it went through
        if self._blocks:
            self.link.write(LEFT, wanted)
        else:
            self.link.write(LEFT, wanted[:1])
            self.link.write(RIGHT, wanted[1:])
        self._sent = wanted


def failsafe_time(seconds):
    """The byte for a failsafe of this time, brought to 0.1 to 2.55 s; 0 or less is none."""
    return min(255, max(10, round(seconds * 100))) if seconds > 0 else 0


def encode(speed):
    """The drive byte for a speed in [-1, 1]: 0x80 stands, and forward counts down, as the JetBot's motors are wired.

    Full backward would be 256, which a byte wraps to 0, full forward; 255 is as near as it gets.
    """
    return min(255, max(0, 128 - round(speed * 128)))
