"""From what a person sees a robot do to the controller's parameters; no terminal and no motion.

Where a robot ends after a square, driven both ways round, shows its systematic errors. J. Borenstein and L. Feng,
"Measurement and Correction of Systematic Odometry Errors in Mobile Robots" (UMBmark), IEEE Transactions on Robotics and
Automation 12 (6), 1996. Their formulas are for small errors; a search replaces them.
"""

import cmath
import math
from typing import Any, Dict, List, Mapping, NamedTuple, Sequence, Tuple

from jetbot.errors import InvalidValue
from jetbot.kinematics import WHEEL_SEPARATION

from .motions import DRIVE_SPEED

ALPHAS = ("left_motor_alpha", "right_motor_alpha")
QUARTER = math.pi / 2                # rad
STEPS = (0.1, 0.01, 0.001, 0.0001)   # rad; the search tries GRID of each, around the best so far
GRID = range(-6, 7)
MAX_MISFIT = 0.3                     # m, of both ends together

Turn = Tuple[str, int]  # which wheel turned, "left" or "right"; 1 forward, -1 backward


class Errors(NamedTuple):
    """curvature: rad to the left on a metre straight ahead; excess: rad too much in a quarter turn."""

    curvature: float = 0.0
    excess: float = 0.0


def motor_wiring(left_output: Turn, right_output: Turn) -> Dict[str, bool]:
    """Return the parameters for the Turns seen as each output was driven forward; InvalidValue for one wheel twice."""
    directions = dict([left_output, right_output])
    if len(directions) < 2:
        raise InvalidValue(f"the {left_output[0]} wheel cannot have turned both times", "Repeat both motions.")
    return {"swap_motors": left_output[0] == "right",
            "invert_left": directions["left"] < 0, "invert_right": directions["right"] < 0}


def base_wiring(ahead: int, left_turn: int) -> Dict[str, bool]:
    """Return the parameters of a robot that was driven ahead and turned left: 1 for as commanded, -1 for opposite."""
    return {"swap_motors": ahead != left_turn, "invert_left": ahead < 0, "invert_right": ahead < 0}


def curvature_of(drift: float) -> float:
    """Return the curvature, in rad/m, of a path that is ``drift`` m left of the line after one metre."""
    return 2 * drift / (1 + drift ** 2)


def base_alpha(min_duty: float) -> float:
    """Return what min_duty adds to the effect of an alpha at DRIVE_SPEED."""
    return min_duty / (1 - min_duty) / DRIVE_SPEED


def trim(left_alpha: float, right_alpha: float, curvature: float, min_duty: float = 0.0) -> Tuple[float, float]:
    """Return better alphas (left, right) for a robot whose path has a curvature, in rad/m to the left.

    Its wheels' speeds, which are proportional to their duties, differ by the part curvature * WHEEL_SEPARATION; each
    alpha makes up half of that. The larger of the returned alphas is 1.
    """
    change, base = curvature * WHEEL_SEPARATION / 2, base_alpha(min_duty)
    left, right = (left_alpha + base) * (1 + change) - base, (right_alpha + base) * (1 - change) - base
    return round(left / max(left, right), 4), round(right / max(left, right), 4)


def proportional_alphas(left_alpha: float, right_alpha: float, min_duty: float) -> Tuple[float, float]:
    """Return the alphas (left, right) that without a min_duty give the ratio of duties that these give at DRIVE_SPEED.

    The larger of the returned alphas is 1.
    """
    return trim(left_alpha + base_alpha(min_duty), right_alpha + base_alpha(min_duty), 0.0)


def square_ends(errors: Errors) -> List[complex]:
    """Return where a robot ends after a square to the left, and after one to the right: m ahead + 1j * m left."""
    arc = 1j * errors.curvature
    side = (cmath.exp(arc) - 1) / arc if arc else 1.0
    corners = (errors.curvature + way * (QUARTER + errors.excess) for way in (1, -1))
    return [side * sum(cmath.exp(1j * corner * count) for count in range(4)) for corner in corners]


def find_errors(ends: Sequence[complex]) -> Errors:
    """Return the errors, below 0.67 rad each, that best explain the ``square_ends``.

    Raises InvalidValue if no errors explain both ends.
    """
    def misfit(errors):
        return sum(abs(seen - end) for seen, end in zip(ends, square_ends(errors)))

    best = Errors()
    for step in STEPS:
        near = [Errors(best.curvature + i * step, best.excess + j * step) for i in GRID for j in GRID]
        best = min(near, key=misfit)
    if misfit(best) > MAX_MISFIT:
        raise InvalidValue("no robot ends like that after both squares",
                           "Check ahead and behind, left and right, and drive them again.")
    return best


def corrected(parameters: Mapping[str, Any], errors: Errors) -> Dict[str, float]:
    """Return better alphas, max_speed and wheel_separation for a robot with these parameters and errors.

    The turn shows the separation on this floor; the trim slows down one wheel, and with it the robot.
    """
    left, right = (parameters[name] for name in ALPHAS)
    alphas = trim(left, right, errors.curvature)
    slower = alphas[0] / left * (1 - errors.curvature * WHEEL_SEPARATION / 2)
    return {**dict(zip(ALPHAS, alphas)), "max_speed": round(parameters["max_speed"] * slower, 4),
            "wheel_separation": round(parameters["wheel_separation"] * QUARTER / (QUARTER + errors.excess), 4)}
