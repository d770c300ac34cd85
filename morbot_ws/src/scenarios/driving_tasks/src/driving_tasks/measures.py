"""What a task measures: each measure returns errors in cm or degrees, each with a sentence and its place."""

import math
from typing import Callable, List, NamedTuple

from .course import SPACING, Course, Point, relative
from .drive import Drive


class Error(NamedTuple):
    """size: in cm or degrees; sentence: what the robot did, without a full stop; place: (x, y) in the task's frame."""

    size: float
    sentence: str
    place: Point


Measure = Callable[[Course, Drive], List[Error]]


def end(course: Course, drive: Drive) -> List[Error]:
    """Return how far the robot stopped from the goal, or how wrong its heading was there: the larger of the two."""
    goal, stop = course.goal, drive.end
    seen = relative(stop, goal)
    distance, turn = 100 * math.hypot(seen.x, seen.y), math.degrees(seen.yaw)
    if abs(turn) > distance:
        sentence = turned(math.degrees(stop.yaw), math.degrees(goal.yaw), "at the end")
    else:
        sentence = f"stopped {_beside_goal(100 * seen.x, 100 * seen.y)}"
    return [Error(max(distance, abs(turn)), sentence, stop[:2])]


def turned(degrees: float, wanted: float, where: str) -> str:
    """Return what is wrong with a turn of some degrees, counterclockwise, where another one was wanted."""
    if not wanted:
        return f"pointed {amount(degrees, 'degree')} too far to the {side(degrees)} {where}"
    if degrees * wanted < 0 and abs(degrees) > 10:
        return f"turned to the {side(degrees)} {where}, and not to the {side(wanted)}"
    error = math.copysign(1, wanted) * (degrees - wanted)
    return f"turned {amount(error, 'degree')} too {'far' if error > 0 else 'little'} {where}"


def _beside_goal(ahead, left):
    """Return where the robot is, in cm, as seen from the goal; the smaller distance only if it is half the larger."""
    along = amount(ahead, "cm") + (" past" if ahead > 0 else " short of")
    across = f"{amount(left, 'cm')} {side(left)} of"
    first, second = sorted([(abs(ahead), along), (abs(left), across)], reverse=True)
    return f"{first[1]} the goal" + (f" and {second[1]} it" if 2 * second[0] >= first[0] > 0 else "")


def side(value: float) -> str:
    """Return left for a positive offset or turn, else right."""
    return "left" if value > 0 else "right"


def amount(value: float, unit: str) -> str:
    """Return a size for people: 4.8 cm, 12 cm, 1 degree, 8 degrees."""
    number = f"{abs(value):.1f}" if abs(value) < 9.95 else f"{abs(value):.0f}"
    number = number[:-2] if number.endswith(".0") else number
    return f"{number} {unit}{'s' if unit != 'cm' and number != '1' else ''}"
