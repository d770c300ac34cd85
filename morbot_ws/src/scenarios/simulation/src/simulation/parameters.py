"""What may be set on a simulated robot. Where its sizes come from, config/jetbot.yaml tells."""

from jetbot.fake_motors import MOTORS
from jetbot.parameters import NUMBER, POSITIVE, SECONDS, Parameter, is_number


def is_fake(bus):
    """Whether this names a fake bus."""
    return str(bus) == "fake" or str(bus).startswith("fake:")


PARAMETERS = {
    "board": Parameter("jetbot", lambda value: value in list(MOTORS), f"one of {', '.join(MOTORS)}"),
    "i2c_bus": Parameter("fake", is_fake, "fake, or fake:FOLDER"),
    "wheel_separation": Parameter(0.1125, *POSITIVE),  # m
    "wheel_diameter": Parameter(0.06, *POSITIVE),      # m
    "max_speed": Parameter(0.6, *POSITIVE),            # m/s
    "motor_lag": Parameter(0.1, *SECONDS),
    "dead_band": Parameter(0.05, lambda value: is_number(value) and 0 <= value < 1, "a duty, 0 or more and below 1"),
    "x": Parameter(0.0, *NUMBER),                      # m
    "y": Parameter(0.0, *NUMBER),                      # m
    "yaw": Parameter(0.0, *NUMBER),                    # rad, counterclockwise
}
