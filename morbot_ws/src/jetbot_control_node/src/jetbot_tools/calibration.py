"""From what a person sees a robot do to the controller's parameters; no terminal and no motion."""

import json
from typing import Any, Dict, Mapping, Tuple

from jetbot.errors import InvalidValue
from jetbot_ros.parameters import PARAMETERS

WHEEL_SEPARATION = 0.1125  # m; NVIDIA's model of the JetBot in Isaac Sim

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


def trim(left_alpha: float, right_alpha: float, drift: float) -> Tuple[float, float]:
    """Return better alphas (left, right) for a robot ``drift`` m left of the line, negative: right, after one metre.

    The path is an arc of curvature 2 * drift / (1 + drift^2), on which the wheels' speeds differ by
    curvature * WHEEL_SEPARATION; each alpha makes up half of that. The larger of the returned alphas is 1.
    """
    change = drift / (1 + drift ** 2) * WHEEL_SEPARATION
    left, right = left_alpha * (1 + change), right_alpha * (1 - change)
    return round(left / max(left, right), 4), round(right / max(left, right), 4)


def as_yaml(values: Mapping[str, Any]) -> str:
    """Return parameters as a YAML file with the meaning of each as a comment."""
    lines = ["# Made by calibrate.py for one robot; the controller loads it. Without this file, the defaults apply."]
    lines += [f"{name}: {json.dumps(values[name])}  # {row.doc}" for name, row in PARAMETERS.items() if name in values]
    return "\n".join(lines) + "\n"
