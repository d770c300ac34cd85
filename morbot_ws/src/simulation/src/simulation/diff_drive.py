"""A differential-drive robot: two motors, and the pose that results."""

import math
from typing import Dict, Optional, Tuple

from jetbot.kinematics import Pose, mix

from .collision import Collision

Pair = Tuple[float, float]  # left, right

PWM_FREQUENCY = 1526.0  # Hz, at which a dead band is given
STOPPED_BELOW = 1e-5    # m/s; a wheel that slows down would never be at 0
# Adafruit, "Improve Low-Speed Performance of Brushed DC Motors": a gear motor (product 4416) starts at 1.4 V of 5 V at
# 1600 Hz, and at 0.1 V at 25 Hz.
STARTING_EXPONENT = math.log(1.4 / 0.1) / math.log(1600 / 25)


class Motor:
    """A geared DC motor with its wheel, stopped at first.

    max_speed: m/s at full duty; lag: time constant in seconds (63 % of a change of speed), 0 for none;
    dead_band: duty in [0, 1) below which the motor does not turn, at ``PWM_FREQUENCY``; smaller at lower frequencies.
    stalled: whether it gets some power, but too little to turn; duty: the last one applied; speed: m/s;
    distance: metres rolled so far, negative for backward.
    """

    def __init__(self, max_speed: float, lag: float, dead_band: float):
        self._max_speed, self._lag, self._dead_band = max_speed, lag, dead_band
        self.duty = self.speed = self.distance = 0.0
        self.stalled = False

    def step(self, duty: float, seconds: float, pwm_frequency: float = PWM_FREQUENCY) -> float:
        """Apply a duty in [-1, 1] for some time, at a frequency in Hz; return the metres that the wheel rolls."""
        starts_at = self._dead_band * (pwm_frequency / PWM_FREQUENCY) ** STARTING_EXPONENT
        self.duty, self.stalled = duty, 0 < abs(duty) < starts_at
        target = 0.0 if self.stalled else duty * self._max_speed
        error = self.speed - target
        decay = math.exp(-seconds / self._lag) if self._lag else 0.0
        rolled = target * seconds + error * self._lag * (1 - decay)  # the integral of the speed over the time
        self.speed = target + error * decay
        if not target and abs(self.speed) < STOPPED_BELOW:
            self.speed = 0.0
        self.distance += rolled
        return rolled

    def block(self, rest: float) -> None:
        """Stop the wheel at once, before the last metres that ``step`` has returned."""
        self.speed = 0.0
        self.distance -= rest


class DiffDriveModel:
    """A robot that starts at ``pose``. Sizes in m, max_speed in m/s; motor_lag, dead_band: see ``Motor``.

    wheel_ratio: diameter of the right wheel over that of the left one; wheel_diameter and max_speed are the left one's.
    closed_loop: whether the board controls the speeds of the wheels. Otherwise it sets their duties.
    collision: the walls that stop the robot, or None.
    """

    def __init__(self, wheel_separation: float, wheel_diameter: float, max_speed: float, motor_lag: float,
                 dead_band: float, pose: Pose, closed_loop: bool = False, wheel_ratio: float = 1.0):
        self.left, self.right = (Motor(speed, motor_lag, 0.0 if closed_loop else dead_band)
                                 for speed in (max_speed, max_speed * wheel_ratio))
        self.pose = pose
        self._geometry = wheel_separation, max_speed
        self._radii = wheel_diameter / 2, wheel_diameter / 2 * wheel_ratio
        self._closed_loop = closed_loop
        self.collision: Optional[Collision] = None

    def step(self, speeds: Pair, seconds: float, pwm_frequency: float = PWM_FREQUENCY) -> None:
        """Drive for some seconds at the board's wheel speeds (left, right), at a PWM frequency in Hz.

        They are duties in [-1, 1]; of a closed loop, m/s of wheels that are 2 m apart.
        """
        left, right = speeds
        if self._closed_loop:
            left, right = mix((left + right) / 2, (right - left) / 2, *self._geometry)
        self._roll(self.left.step(left, seconds, pwm_frequency), self.right.step(right, seconds, pwm_frequency))

    def _roll(self, left, right):
        """Move the robot as its wheels roll, these metres, up to a wall."""
        if not self.collision:
            self.pose = self.pose.integrate_arc(left, right, self._geometry[0])
            return
        self.pose, driven = self.collision.drive(self.pose, left, right, self._geometry[0])
        if driven < 1:
            self.left.block(left * (1 - driven))
            self.right.block(right * (1 - driven))

    @property
    def moving(self) -> bool:
        """Whether a wheel turns."""
        return bool(self.left.speed or self.right.speed)

    @property
    def touching(self) -> bool:
        """Whether the robot touches a wall, or has touched one and is still near it."""
        return bool(self.collision and self.collision.touching)

    @property
    def velocity(self) -> Tuple[float, float]:
        """The velocity (linear in m/s, angular in rad/s) in the robot's own frame."""
        return (self.left.speed + self.right.speed) / 2, (self.right.speed - self.left.speed) / self._geometry[0]

    @property
    def joints(self) -> Tuple[Pair, Pair]:
        """The rotations of the wheels (left, right) since the start in rad, and their angular speeds in rad/s."""
        left, right, (left_radius, right_radius) = self.left, self.right, self._radii
        return ((left.distance / left_radius, right.distance / right_radius),
                (left.speed / left_radius, right.speed / right_radius))

    @property
    def stalled(self) -> Dict[str, float]:
        """The duties of the wheels that get some power, but too little to turn; their names are left and right."""
        wheels = {"left": self.left, "right": self.right}
        return {name: wheel.duty for name, wheel in wheels.items() if wheel.stalled}
