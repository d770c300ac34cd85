"""The body of a calibrated robot, for the simulation: a simulated robot that needs the same corrections."""

from typing import Any, Dict, Mapping

from jetbot.boards import DEFAULT_PWM_FREQUENCY
from jetbot.fake.motors import dead_band_factor

from .corrections import ALPHAS, proportional_alphas

MEASURED = ("swap_motors", "invert_left", "invert_right", "wheel_separation")
MAX_DEAD_BAND = 0.99


def body_of(parameters: Mapping[str, Any], dead_band: float) -> Dict[str, Any]:
    """Return the parameters of ``body`` in the simulation, of a robot for which the calibration has found these.

    dead_band: the smallest duty that turns both wheels. What was not measured is left out.
    """
    body = {name: parameters[name] for name in MEASURED if name in parameters}
    if not dead_band:  # the board controls the wheels
        return body
    left, right = proportional_alphas(*(parameters[name] for name in ALPHAS), parameters.get("min_duty", 0.0))
    if "max_speed" in parameters:
        body["max_speed"] = round(parameters["max_speed"] / left, 4)
    frequency = parameters.get("pwm_frequency", DEFAULT_PWM_FREQUENCY)
    return {**body, "wheel_ratio": round(left / right, 4),
            "dead_band": min(MAX_DEAD_BAND, round(dead_band / dead_band_factor(frequency), 4))}
