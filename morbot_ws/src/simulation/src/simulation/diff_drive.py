"""A differential-drive robot: two motors, and the pose that results."""

from typing import Tuple

from jetbot.kinematics import clamp, mix

from .motor import Motor
from .pose import Pose

Pair = Tuple[float, float]  # left, right


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
            left, right = (clamp(duty, 1.0) for duty in mix((left + right) / 2, (right - left) / 2, *self._geometry))
        distances = self.left.step(left, seconds), self.right.step(right, seconds)
        self.pose = self.pose.integrate_arc(*distances, self._geometry[0])

    @property
    def velocity(self) -> Pair:
        """The velocity (linear in m/s, angular in rad/s) in the robot's own frame."""
        return (self.left.speed + self.right.speed) / 2, (self.right.speed - self.left.speed) / self._geometry[0]

    @property
    def wheel_angles(self) -> Pair:
        """The rotation of the wheels (left, right) since the start, in radians."""
        return self.left.distance / self._wheel_radius, self.right.distance / self._wheel_radius

    @property
    def wheel_rates(self) -> Pair:
        """The angular speeds of the wheels (left, right), in rad/s."""
        return self.left.speed / self._wheel_radius, self.right.speed / self._wheel_radius
