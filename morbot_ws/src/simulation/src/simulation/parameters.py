"""What may be set on a simulated robot. Where its sizes come from, config/jetbot.yaml tells."""

from jetbot.fake.motors import WIRED
from jetbot.i2c import fake_folder
from jetbot_ros.parameters import NUMBER, PART, POSITIVE, SECONDS, Parameter


def is_fake(bus):
    """Whether this names a fake bus."""
    return bus == "fake" or bool(fake_folder(str(bus)))


PARAMETERS = {
    "board": Parameter("jetbot", lambda value: value in WIRED, f"one of {', '.join(WIRED)}"),
    "i2c_bus": Parameter("fake", is_fake, "fake, or fake:FOLDER"),
    "wheel_separation": Parameter(0.1125, *POSITIVE),  # m
    "wheel_diameter": Parameter(0.06, *POSITIVE),      # m
    "max_speed": Parameter(0.6, *POSITIVE),            # m/s
    "motor_lag": Parameter(0.1, *SECONDS),
    "dead_band": Parameter(0.05, *PART),
    "x": Parameter(0.0, *NUMBER),                      # m
    "y": Parameter(0.0, *NUMBER),                      # m
    "yaw": Parameter(0.0, *NUMBER),                    # rad, counterclockwise
}
