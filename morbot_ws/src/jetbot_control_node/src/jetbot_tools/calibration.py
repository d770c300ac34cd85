"""What the calibration's observations mean as parameters of the controller. No terminal and no motion here."""

import json

from jetbot.errors import InvalidValue

WHEEL_SEPARATION = 0.1125  # m; NVIDIA's model of the JetBot in Isaac Sim

COMMENTS = {
    "board": "which motor board this robot has",
    "i2c_bus": "N for /dev/i2c-N, or a fake bus",
    "port": "serial port of a JetBot Pro",
    "swap_motors": "true: the left motor is connected as the right one, and vice versa",
    "invert_left": "true: the left motor turns the wrong way",
    "invert_right": "true: the right motor turns the wrong way",
    "left_motor_alpha": "trim of the left wheel; the one that is too fast gets less",
    "right_motor_alpha": "trim of the right wheel",
    "min_duty": "least part of full power that turns both wheels",
}


def orientation(left_output, right_output):
    """Parameters from what was seen when each output was driven forward: (wheel, way), "left" or "right", and 1 or -1.

    Raises InvalidValue when the same wheel was seen twice.
    """
    ways = dict([left_output, right_output])
    if len(ways) < 2:
        raise InvalidValue(f"the {left_output[0]} wheel cannot have turned both times", "Look again.")
    return {"swap_motors": left_output[0] == "right",
            "invert_left": ways["left"] < 0, "invert_right": ways["right"] < 0}


def orientation_of_both(ahead, turn):
    """Parameters of a robot whose wheels cannot be driven alone, from what was seen when it was to drive ahead and to
    turn to the left: 1 when it did, -1 when it did the opposite."""
    return {"swap_motors": ahead != turn, "invert_left": ahead < 0, "invert_right": ahead < 0}


def trim(left_alpha, right_alpha, drift):
    """Better alphas (left, right) for a robot that ends ``drift`` metres left of the line after one metre ahead.

    A drift to the right is negative. The path is an arc of curvature 2 * drift / (1 + drift^2), and on it the wheels'
    speeds differ by curvature * WHEEL_SEPARATION. The larger of the new alphas is 1.
    """
    difference = 2 * drift / (1 + drift ** 2) * WHEEL_SEPARATION / 2
    left, right = left_alpha * (1 + difference), right_alpha * (1 - difference)
    return round(left / max(left, right), 4), round(right / max(left, right), 4)


def as_yaml(parameters):
    """The parameters as a YAML file with a comment for each."""
    lines = ["# Made by calibrate.py for one robot; the controller loads it. Without this file, the defaults hold."]
    lines += [f"{name}: {json.dumps(parameters[name])}  # {comment}"
              for name, comment in COMMENTS.items() if name in parameters]
    return "\n".join(lines) + "\n"
