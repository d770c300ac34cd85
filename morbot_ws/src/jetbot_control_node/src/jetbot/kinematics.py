"""From a Twist to two wheel speeds."""

import sys
from typing import Tuple


def clamp(value: float, limit: float) -> float:
    """Return the value, limited to [-limit, limit]."""
    return max(-limit, min(limit, value))


def mix(linear: float, angular: float, wheel_separation: float = 2.0, max_speed: float = 1.0) -> Tuple[float, float]:
    """Return the wheel speeds (left, right) that move the robot as asked, 1 for a wheel at full power.

    linear: forward speed in m/s; angular: turn to the left in rad/s; both finite.
    wheel_separation: metres between the wheels; max_speed: m/s of a wheel at full power.
    The defaults make it the workshop's left = linear - angular, right = linear + angular.
    The speeds are finite, and not limited to what the robot can do.
    """
    turn = angular * (wheel_separation / 2)
    left, right = (linear - turn) / max_speed, (linear + turn) / max_speed
    return clamp(left, sys.float_info.max), clamp(right, sys.float_info.max)
