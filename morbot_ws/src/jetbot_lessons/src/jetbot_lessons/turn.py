"""The command of lesson 3's exercise: turn on the spot, to the right, and slowly."""

import math

from . import Problem

MAX_TURN = 0.2   # of full power; more is not slow
MIN_TURN = 0.01  # of full power; less may turn no wheel
EXAMPLE = "for example '{angular: {z: -0.05}}'"


def check_command(x: float, z: float) -> Problem:
    """Return the problem, or None if this command, linear.x and angular.z, is that of the exercise."""
    if not (math.isfinite(x) and math.isfinite(z)):
        return f"Your command has linear.x {x:g} and angular.z {z:g}: write numbers, {EXAMPLE}"
    if x:
        return (f"Your command has linear.x {x:g}, so the robot drives {'forward' if x > 0 else 'backward'}: "
                "leave linear.x at 0, and it turns on the spot")
    if z > 0:
        return f"Your command has angular.z {z:g}, which turns the robot to the left: write a number below 0"
    if z > -MIN_TURN:
        return f"Your command has angular.z {z:g}, which turns no wheel: write {-MIN_TURN} or less, {EXAMPLE}"
    if z < -MAX_TURN:
        return f"Your command has angular.z {z:g}, which is fast: write a number between {-MAX_TURN} and 0, {EXAMPLE}"
    return None
