"""Motors behind H bridges on the outputs of a PCA9685: how two wheel speeds become duties."""

from typing import Dict, List, NamedTuple, Optional, Sequence

from .driver import DEFAULT_PWM_FREQUENCY, Link, MotorDriver
from .pca9685 import FULL_DUTY, PCA9685


class HBridge(NamedTuple):
    """Which PCA9685 outputs turn one wheel.

    forward, backward: the output that is high while the wheel turns that way.
    pwm: the output that carries the duty; None if the direction's own output carries it.
    """

    forward: int
    backward: int
    pwm: Optional[int] = None

    def duties(self, speed: float) -> Dict[int, int]:
        """Return {output: duty} for a speed in [-1, 1]: never both directions, and all low when stopped."""
        duty = round(abs(speed) * FULL_DUTY)
        active, idle = (self.forward, self.backward) if speed > 0 else (self.backward, self.forward)
        if self.pwm is None:
            return {active: duty, idle: 0}
        return {self.pwm: duty, active: FULL_DUTY if duty else 0, idle: 0}


class Wiring(NamedTuple):
    """The two wheels of a board."""

    left: HBridge
    right: HBridge

    @property
    def outputs(self) -> List[int]:
        """The PCA9685 outputs that are used: first those without which neither direction gets power."""
        duties = [bridge.pwm for bridge in self if bridge.pwm is not None]
        return duties + [output for bridge in self for output in (bridge.forward, bridge.backward)]


# Both as in the JetBot library, https://github.com/NVIDIA-AI-IOT/jetbot, jetbot/motor.py.
# Adafruit's FeatherWing 2927 and Motor HAT with a TB6612: motors M1 and M2, by the numbers of Adafruit_MotorHAT. The
# robot moves forward when they run what that library calls backward, IN2 high.
ADAFRUIT = Wiring(left=HBridge(forward=9, backward=10, pwm=8), right=HBridge(forward=12, backward=11, pwm=13))

# Waveshare's JetBot board: the duty is on the direction outputs.
WAVESHARE = Wiring(left=HBridge(forward=1, backward=0), right=HBridge(forward=2, backward=3))

# Waveshare's Motor Driver HAT for the Raspberry Pi, a TB6612: its library's forward is IN1 low and IN2 high.
WAVESHARE_HAT = Wiring(left=HBridge(forward=2, backward=1, pwm=0), right=HBridge(forward=4, backward=3, pwm=5))


class PwmMotors(PCA9685, MotorDriver):
    """Drives motors on a PCA9685 in one wiring or, if the boards cannot be distinguished, in several at once."""

    resolution = 1 / FULL_DUTY
    chip_name = "PCA9685"

    def __init__(self, link: Link, pwm_frequency: float = DEFAULT_PWM_FREQUENCY, wirings: Sequence[Wiring] = ()):
        super().__init__(link, pwm_frequency, [wiring.outputs for wiring in wirings])
        self._wirings = wirings

    def drive(self, left: float, right: float) -> None:
        duties: Dict[int, int] = {}
        for wiring in self._wirings:
            duties.update(wiring.left.duties(left))
            duties.update(wiring.right.duties(right))
        self.set_outputs(duties)
