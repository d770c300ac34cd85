"""From what a person sees a robot do to the controller's parameters; no terminal and no motion."""

from typing import Dict, Tuple

from jetbot.errors import InvalidValue
from jetbot.kinematics import WHEEL_SEPARATION

from .motions import DRIVE_SPEED

ALPHAS = ("left_motor_alpha", "right_motor_alpha")

Turn = Tuple[str, int]  # which wheel turned, "left" or "right"; 1 forward, -1 backward


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
