"""UMBmark: the systematic errors of a robot, from where it ends after a square of 1 m, driven both ways round.

J. Borenstein and L. Feng, "Measurement and Correction of Systematic Odometry Errors in Mobile Robots", IEEE
Transactions on Robotics and Automation 12 (6), 1996. Their formulas are for small errors; a search replaces them.
"""

import cmath
import math
from typing import Any, Dict, List, Mapping, NamedTuple, Sequence

from jetbot.errors import InvalidValue
from jetbot.kinematics import WHEEL_SEPARATION

from .calibration import ALPHAS, trim

QUARTER = math.pi / 2                # rad
STEPS = (0.1, 0.01, 0.001, 0.0001)   # rad; the search tries GRID of each, around the best so far
GRID = range(-6, 7)
MAX_MISFIT = 0.3                     # m, of both ends together


class Errors(NamedTuple):
    """curvature: rad to the left on a metre straight ahead; excess: rad too much in a quarter turn."""

    curvature: float = 0.0
    excess: float = 0.0


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

    The turn tells the separation on this floor; the trim slows down one wheel, and with it the robot.
    """
    left, right = (parameters[name] for name in ALPHAS)
    alphas = trim(left, right, errors.curvature)
    slower = alphas[0] / left * (1 - errors.curvature * WHEEL_SEPARATION / 2)
    return {**dict(zip(ALPHAS, alphas)), "max_speed": round(parameters["max_speed"] * slower, 4),
            "wheel_separation": round(parameters["wheel_separation"] * QUARTER / (QUARTER + errors.excess), 4)}
