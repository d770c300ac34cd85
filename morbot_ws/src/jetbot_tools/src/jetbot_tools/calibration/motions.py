"""Motions: lists of what the wheels do, in steps of at most STEP seconds."""

from typing import Any, List, Mapping, NamedTuple

from jetbot.motor import duty

STEP = 0.022        # s between two calls to the robot, which feed its watchdogs
RAMP_STEPS = 7      # until a gentle motion has its full speed, and until it has lost it
START_SPEED = 0.08  # fraction of full power at which it starts and ends: above the dead band, so that each step counts
DRIVE_SPEED = 0.4   # fraction of full power, to drive ahead
SPIN_SPEED = 0.2    # fraction of full power, to turn on the spot


class WheelStep(NamedTuple):
    """Wheel speeds, as Robot.set_motors takes them, and how long they are held."""

    left: float
    right: float
    seconds: float = STEP


def constant_speed(left: float, right: float, seconds: float) -> List[WheelStep]:
    """Return a motion at these speeds."""
    count, rest = divmod(seconds, STEP)
    return [*[WheelStep(left, right)] * int(count), WheelStep(left, right, rest)]


def gentle(left: float, right: float, seconds: float, min_duty: float = 0.0) -> List[WheelStep]:
    """Return a motion that rolls as far as these speeds, equal but for the sign, do in ``seconds``.

    It starts and ends at START_SPEED.
    """
    lowest = START_SPEED / abs(left)
    parts = [lowest + (1 - lowest) * step / RAMP_STEPS for step in range(RAMP_STEPS)]
    rising = [WheelStep(left * part, right * part) for part in parts]
    ramp = 2 * STEP * sum(duty(abs(step.left), min_duty) for step in rising) / duty(abs(left), min_duty)
    return [*rising, *constant_speed(left, right, max(0.0, seconds - ramp)), *reversed(rising)]


def spin(angle: float, parameters: Mapping[str, Any]) -> List[WheelStep]:
    """Return a turn to the left on the spot by an angle in rad, of a robot with these parameters."""
    metres = angle * parameters["wheel_separation"] / 2
    return gentle(-SPIN_SPEED, SPIN_SPEED, metres / (parameters["max_speed"] * SPIN_SPEED))
