"""A differential-drive robot: two motors, and the pose that results."""

import math
from typing import Tuple

from jetbot.kinematics import Pose, mix

Pair = Tuple[float, float]  # left, right


class Motor:
    """A geared DC motor with its wheel, stopped at first.

    max_speed: m/s at full duty; lag: time constant in seconds (63 % of a change of speed), 0 for none;
    dead_band: duty in [0, 1) below which the motor does not turn.
    speed: m/s; distance: metres rolled so far, negative for backward.
    """

    def __init__(self, max_speed: float, lag: float, dead_band: float):
        self._max_speed, self._lag, self._dead_band = max_speed, lag, dead_band
        self.speed = self.distance = 0.0

    def step(self, duty: float, seconds: float) -> float:
        """Apply a duty in [-1, 1] for some time; return the metres that the wheel rolls."""
        target = duty * self._max_speed if abs(duty) >= self._dead_band else 0.0
        error = self.speed - target
        decay = math.exp(-seconds / self._lag) if self._lag else 0.0
        rolled = target * seconds + error * self._lag * (1 - decay)  # the integral of the speed over the time
        self.speed = target + error * decay
        self.distance += rolled
        return rolled


class DiffDriveModel:
    """A robot that starts at ``pose``. Sizes in m, max_speed in m/s; motor_lag, dead_band: see ``Motor``.

    closed_loop: whether the board controls the speeds of the wheels. Otherwise it sets their duties.
    """

    def __init__(self, wheel_separation: float, wheel_diameter: float, max_speed: float, motor_lag: float,
                 dead_band: float, pose: Pose, closed_loop: bool = False):
        self.left, self.right = (Motor(max_speed, motor_lag, 0.0 if closed_loop else dead_band) for _ in range(2))
        self.pose = pose
        self._geometry = wheel_separation, max_speed
        self._wheel_radius = wheel_diameter / 2
        self._closed_loop = closed_loop

    def step(self, speeds: Pair, seconds: float) -> None:
        """Drive for some seconds at the board's wheel speeds (left, right).

        They are duties in [-1, 1]; of a closed loop, m/s of wheels that are 2 m apart.
        """
        left, right = speeds
        if self._closed_loop:
            left, right = mix((left + right) / 2, (right - left) / 2, *self._geometry)
        distances = self.left.step(left, seconds), self.right.step(right, seconds)
        self.pose = self.pose.integrate_arc(*distances, self._geometry[0])

    @property
    def velocity(self) -> Tuple[float, float]:
        """The velocity (linear in m/s, angular in rad/s) in the robot's own frame."""
        return (self.left.speed + self.right.speed) / 2, (self.right.speed - self.left.speed) / self._geometry[0]

    @property
    def joints(self) -> Tuple[Pair, Pair]:
        """The rotations of the wheels (left, right) since the start in rad, and their angular speeds in rad/s."""
        left, right, radius = self.left, self.right, self._wheel_radius
        return (left.distance / radius, right.distance / radius), (left.speed / radius, right.speed / radius)
