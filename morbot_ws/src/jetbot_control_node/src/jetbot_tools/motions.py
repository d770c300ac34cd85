"""Motions: lists of what the wheels do, in steps of at most STEP seconds."""

import math
from typing import Any, List, Mapping, NamedTuple

STEP = 0.022       # s between two calls to the robot, which feed its watchdogs
RAMP_STEPS = 7     # until a gentle motion has its full speed, and until it has lost it
DRIVE_SPEED = 0.4  # fraction of full power, to drive ahead
SPIN_SPEED = 0.2   # fraction of full power, to turn on the spot


class Step(NamedTuple):
    """Wheel speeds, as Robot.set_motors takes them, and how long they are held."""

    left: float
    right: float
    seconds: float = STEP


def steady(left: float, right: float, seconds: float) -> List[Step]:
    """Return a motion at these speeds."""
    count, rest = divmod(seconds, STEP)
    return [*[Step(left, right)] * int(count), Step(left, right, rest)]


def gentle(left: float, right: float, seconds: float) -> List[Step]:
    """Return a motion that rolls as far as these speeds do in ``seconds``; it starts and ends at lower speeds."""
    parts = [step / (RAMP_STEPS + 1) for step in range(1, RAMP_STEPS + 1)]
    rising = [Step(left * part, right * part) for part in parts]
    return [*rising, *steady(left, right, max(0.0, seconds - 2 * STEP * sum(parts))), *reversed(rising)]


def ahead(metres: float, max_speed: float) -> List[Step]:
    """Return a drive straight ahead of a robot with this max_speed (m/s)."""
    return gentle(DRIVE_SPEED, DRIVE_SPEED, metres / (DRIVE_SPEED * max_speed))


def spin(angle: float, parameters: Mapping[str, Any]) -> List[Step]:
    """Return a turn on the spot by an angle in rad, positive to the left, of a robot with these parameters."""
    roll = abs(angle) * parameters["wheel_separation"] / 2  # m, of each wheel
    speed = math.copysign(SPIN_SPEED, angle)
    return gentle(-speed, speed, roll / (SPIN_SPEED * parameters["max_speed"]))


def square(way: int, parameters: Mapping[str, Any]) -> List[Step]:
    """Return a square with sides of 1 m and four quarter turns. way: 1 to the left, -1 to the right."""
    return 4 * (ahead(1.0, parameters["max_speed"]) + spin(way * math.pi / 2, parameters))
