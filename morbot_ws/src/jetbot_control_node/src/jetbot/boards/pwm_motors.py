"""Motors behind H bridges on the outputs of a PCA9685: how two wheel speeds become duties."""

import time
from typing import NamedTuple, Optional

from .pca9685 import FULL_DUTY, PCA9685

VERIFY_AFTER_COMMAND = 0.25  # seconds between two checks of the chip, when a command has just gone out
VERIFY_IDLE = 0.4            # seconds, at any other moment: so a check seldom holds up a command


class HBridge(NamedTuple):
    """Which PCA9685 outputs turn one wheel.

    forward, backward: the output that is high while the wheel turns that way.
    pwm: the output that carries the duty; None where the direction's own output carries it.
    """

    forward: int
    backward: int
    pwm: Optional[int] = None

    def duties(self, speed):
        """Output: duty for a speed in [-1, 1]; never both directions, and all low at rest."""
        duty = round(abs(speed) * FULL_DUTY)
        active, idle = (self.forward, self.backward) if speed > 0 else (self.backward, self.forward)
        if self.pwm is None:
            return {active: duty, idle: 0}
        return {self.pwm: duty, active: FULL_DUTY if duty else 0, idle: 0}


class Wiring(NamedTuple):
    """The two wheels of a board."""

    left: HBridge
    right: HBridge


# Both as in the JetBot library, https://github.com/NVIDIA-AI-IOT/jetbot, jetbot/motor.py.
# Adafruit's FeatherWing 2927 and Motor HAT with a TB6612: motors M1 and M2, by the numbers of Adafruit_MotorHAT. The
# robot moves forward when they run what that library calls backward, IN2 high.
ADAFRUIT = Wiring(left=HBridge(forward=9, backward=10, pwm=8), right=HBridge(forward=12, backward=11, pwm=13))

# Waveshare's JetBot board: the duty is on the direction outputs.
WAVESHARE = Wiring(left=HBridge(forward=1, backward=0), right=HBridge(forward=2, backward=3))


class PwmMotors:
    """Motors on a PCA9685, wired in one way or, where a scan cannot tell which, in several at once.

    link: an I2CDevice; options: a boards.Options, of which this board needs none.
    """

    def __init__(self, link, options, wirings):
        self.link = link
        self._wirings = wirings
        self._chip = PCA9685(link, [outputs(wiring) for wiring in wirings])
        self._verified = 0.0

    def start(self):
        """Set the board up with both wheels off."""
        self._chip.start()

    def drive(self, left, right):
        """Turn the wheels at these speeds, in [-1, 1]; after a BusError, the next call sets the board up anew."""
        duties = {}
        for wiring in self._wirings:
            duties.update(wiring.left.duties(left))
            duties.update(wiring.right.duties(right))
        self._chip.set_outputs(duties)

    def refresh(self, left, right, idle):
        """Drive as before, and now and then check the chip: it may have lost its power and all that it was told."""
        now = time.monotonic()
        if now - self._verified >= (VERIFY_IDLE if idle else VERIFY_AFTER_COMMAND):
            self._verified = now
            self._chip.verify()
            self.drive(left, right)

    def close(self):
        """Let go of the bus; the wheels go on as they are."""
        self.link.close()


def outputs(wiring):
    """The range of PCA9685 outputs that a wiring uses."""
    used = [output for bridge in wiring for output in bridge.duties(1)]
    return range(min(used), max(used) + 1)
