"""From a Twist to two wheel speeds, and from the distances that two wheels roll to the robot's pose."""

import math
from typing import NamedTuple, Tuple

Point = Tuple[float, float]  # x, y in metres


class Pose(NamedTuple):
    """x, y in metres; yaw in radians, counterclockwise from the x axis (REP 103)."""

    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0

    def advance(self, length: float, rotation: float) -> "Pose":
        """Return the pose at the end of an arc, length in metres, rotation in radians. The yaw is not normalized."""
        chord = length * math.sin(rotation / 2) / (rotation / 2) if rotation else length
        heading = self.yaw + rotation / 2
        return Pose(self.x + chord * math.cos(heading), self.y + chord * math.sin(heading), self.yaw + rotation)

    def integrate_arc(self, left: float, right: float, wheel_separation: float) -> "Pose":
        """Return the pose at the end of the arc on which the wheels roll ``left`` and ``right`` metres."""
        pose = self.advance(*unmix(left, right, wheel_separation))
        return pose._replace(yaw=math.remainder(pose.yaw, math.tau))


def from_frame(pose: Pose, point: Point) -> Point:
    """Return a point of the frame at this pose, in the frame that the pose is in."""
    cosine, sine = math.cos(pose.yaw), math.sin(pose.yaw)
    return pose.x + cosine * point[0] - sine * point[1], pose.y + sine * point[0] + cosine * point[1]


def to_frame(pose: Pose, point: Point) -> Point:
    """Return a point in the frame at this pose: the inverse of ``from_frame``."""
    cosine, sine, x, y = math.cos(pose.yaw), math.sin(pose.yaw), point[0] - pose.x, point[1] - pose.y
    return cosine * x + sine * y, cosine * y - sine * x


WHEEL_SEPARATION = 0.1125  # m; NVIDIA's model of the JetBot in Isaac Sim
WHEEL_RADIUS = 0.03       # m; of the same model
FULL_SPEED = 0.6           # m/s at full power, about, of a 5 V JetBot with 60 mm wheels


def clamp(value: float, limit: float) -> float:
    """Return the value, limited to [-limit, limit]."""
    return max(-limit, min(limit, value))


def mix(linear: float, angular: float, wheel_separation: float = 2.0, max_speed: float = 1.0) -> Tuple[float, float]:
    """Return the wheel speeds (left, right) that move the robot as asked, 1 for a wheel at full power.

    linear: forward speed in m/s; angular: turn to the left in rad/s; both finite.
    wheel_separation: metres between the wheels; max_speed: m/s of a wheel at full power.
    The defaults make it the workshop's left = linear - angular, right = linear + angular.
    The speeds are not limited to what the robot can do; of absurd motions, they are not finite.
    """
    turn = angular * (wheel_separation / 2)
    return (linear - turn) / max_speed, (linear + turn) / max_speed


def unmix(left: float, right: float, wheel_separation: float = 2.0, max_speed: float = 1.0) -> Tuple[float, float]:
    """Return the robot's motion (linear, angular) by that of its wheels: the inverse of ``mix``.

    With the default of max_speed: m/s and rad/s for m/s, m and rad for m.
    """
    return max_speed * (left / 2 + right / 2), max_speed * (right - left) / wheel_separation
