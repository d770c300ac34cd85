"""One wheel of a Robot: from a speed to the duty of its motor."""

import math
from typing import Callable, Dict

from .boards import MotorDriver
from .kinds import NUMBER, check_duties
from .kinematics import clamp

RESIDUE = 1e-9  # speeds this small are rounding errors, as of 0.1 + 0.2 - 0.3: zero, also with a min_duty


class Motor:
    """One wheel of a Robot, whose docstring describes alpha, inverted, min_duty and max_duty.

    speeds: {Motor: speed} as commanded, which the motors of a robot share; drive: is called with such a dict to change
    it and to drive the wheels in it.
    """

    def __init__(self, speeds: Dict["Motor", float], drive: Callable[[Dict["Motor", float]], None], alpha: float,
                 inverted: bool, min_duty: float, max_duty: float):
        check_duties(min_duty, max_duty)
        self._speeds, self._drive = speeds, drive
        self._inverted, self.min_duty, self.max_duty = inverted, float(min_duty), float(max_duty)
        self.alpha = alpha
        speeds[self] = 0.0

    @property
    def value(self) -> float:
        """The speed last set, 1 full forward. Setting it drives the wheel."""
        return self._speeds[self]

    @value.setter
    def value(self, speed: float) -> None:
        self._drive({self: speed})

    @property
    def alpha(self) -> float:
        """The trim: a finite factor of the speed, in force from the next command on."""
        return self._alpha

    @alpha.setter
    def alpha(self, alpha: float) -> None:
        NUMBER.check("an alpha", alpha)
        self._alpha = float(alpha)

    def output(self, driver: MotorDriver) -> float:
        """Return what the driver is given: a duty by trim, clamp, the range from min_duty to max_duty, and sign.

        A board that controls the speeds of its wheels itself is given the speed, which no trim can improve.
        """
        alpha, least, most = (1.0, 0.0, 1.0) if driver.closed_loop else (self.alpha, self.min_duty, self.max_duty)
        speed = clamp(alpha * self._speeds[self], driver.limit)
        if abs(speed) < RESIDUE:
            return 0.0
        return math.copysign(duty(abs(speed), least, most), -speed if self._inverted else speed)

    def speed_of(self, duty: float) -> float:
        """Return the speed at which the wheel turns with this duty, both positive forward; 1 at full power.

        Above its dead band, a motor's speed is about proportional to its mean voltage (Adafruit's TT motor 3777: 120,
        185 and 250 rpm at 3, 4.5 and 6 V). The trim makes unequal motors equal.
        """
        return duty / self.alpha if self.alpha else 0.0

    def duty_of(self, output: float) -> float:
        """Return the duty of an ``output``, positive forward."""
        return -output if self._inverted else output


def duty(speed: float, min_duty: float, max_duty: float = 1.0) -> float:
    """Return the duty of a wheel at a speed in (0, 1]. What its motor then turns is proportional to this duty."""
    return min_duty + (max_duty - min_duty) * speed


def is_cut_off(left: Motor, right: Motor, driver: MotorDriver) -> bool:
    """Return whether both wheels are at their limit, the same way, although a turn, or more than that, was commanded.

    Never with a board that controls the speeds of its wheels itself.
    """
    speeds = [motor.alpha * motor.value for motor in (left, right)]
    saturated = min(speeds) >= driver.limit or max(speeds) <= -driver.limit
    beyond = left.value != right.value or abs(left.value) > driver.limit
    return saturated and beyond and not driver.closed_loop
