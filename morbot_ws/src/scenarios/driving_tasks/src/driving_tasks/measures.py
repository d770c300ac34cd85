"""What a task measures: each measure returns errors in cm or degrees, each with a sentence and its place."""

import math
from statistics import fmean
from typing import Callable, List, NamedTuple, Sequence

from simulation.geometry import distance_to_segment

from .course import SPACING, Course, Point, Straight, Turn, relative
from .drive import Drive
from .polygon import sides as driven_sides

MAX_POINTS = 1000  # of a resampled path: a longer one has fewer points per metre


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
        sentence = turned(math.degrees(stop.yaw), math.degrees(goal.yaw), " at the end")
    else:
        sentence = f"stopped {_beside_goal(100 * seen.x, 100 * seen.y)}"
    return [Error(max(distance, abs(turn)), sentence, stop[:2])]


def line(course: Course, drive: Drive) -> List[Error]:
    """Return how far the driven path and the course are apart: a mean in cm over the path, or over the course.

    The larger of the two: the one sees a path that leaves the line, the other a part of the line that was left out.
    """
    path = resample([sample.pose[:2] for sample in drive.path])
    offsets = [100 * course.offset(*point) for point in path]
    gaps = [100 * min(distance_to_segment(point, *step) for step in zip(path, path[1:])) for point in course.points]
    off, missed = fmean(map(abs, offsets)), fmean(gaps)
    if missed > 2 * off:
        worst, place = max(zip(gaps, course.points))
        return [Error(missed, f"stayed {amount(worst, 'cm')} away from a part of the line", place)]
    worst, place = max(zip(offsets, path), key=lambda each: abs(each[0]))
    sentence = (f"was {amount(off, 'cm')} off the line on average, "
                f"{amount(worst, 'cm')} to the {side(worst)} at worst")
    return [Error(max(off, missed), sentence, place)]


def sides(course: Course, drive: Drive) -> List[Error]:
    """Return how much longer or shorter each side is than it should be; a missing one counts whole."""
    driven, wanted = driven_sides(drive), [step.length for step in course.steps if isinstance(step, Straight)]
    corners, errors = len(driven) - 1, []
    for number, (length, leg) in enumerate(zip(wanted, driven), 1):
        error = 100 * (leg.length - length)
        sentence = (f"drove {amount(error, 'cm')} too {'far' if error > 0 else 'little'} on side {number}"
                    if number <= corners else f"stopped before corner {number}")
        errors.append(Error(abs(error), sentence, leg.end))
    errors += [_missing(100 * length, corners, drive) for length in wanted[len(driven):]]
    beyond = 100 * sum(leg.length for leg in driven[len(wanted):])
    if beyond > errors[-1].size:
        errors[-1] = Error(beyond, f"drove on for {amount(beyond, 'cm')} after corner {len(wanted)}", drive.end[:2])
    return errors


def corners(course: Course, drive: Drive) -> List[Error]:
    """Return how much too far or too little the robot turned at each corner; a missing one counts whole.

    The last turn leads to the heading at the stop.
    """
    wanted = [step.degrees for step in course.steps if isinstance(step, Turn)]
    driven = driven_sides(drive)
    headings = [leg.heading for leg in driven[:len(wanted)]]
    if len(driven) > len(headings):
        headings.append(math.degrees(drive.end.yaw))
    errors = []
    for number, (degrees, before, after, leg) in enumerate(zip(wanted, headings, headings[1:], driven), 1):
        turn = after - before
        errors.append(Error(abs(turn - degrees), turned(turn, degrees, f" at corner {number}"), leg.end))
    return errors + [_missing(abs(degrees), len(errors), drive) for degrees in wanted[len(errors):]]


def _missing(size, corners, drive):
    return Error(size, f"stopped before corner {corners + 1}", drive.end[:2])


def resample(points: Sequence[Point]) -> List[Point]:
    """Return a path as points that are 1 cm apart, or MAX_POINTS of them; first and last as they are."""
    length = sum(map(math.dist, points, points[1:]))
    spacing = max(SPACING, length / MAX_POINTS)
    result, missing = [points[0]], spacing  # how far the next point is
    for start, stop in zip(points, points[1:]):
        step = math.dist(start, stop)
        while missing <= step:
            share = missing / step
            result.append((start[0] + share * (stop[0] - start[0]), start[1] + share * (stop[1] - start[1])))
            missing += spacing
        missing -= step
    return [*result, points[-1]]


def worst(errors: Sequence[Error]) -> Error:
    """Return the largest error; the first of those that are about as large."""
    largest = max(error.size for error in errors)
    return next(error for error in errors if error.size >= 0.95 * largest)


def turned(degrees: float, wanted: float, where: str) -> str:
    """Return what is wrong with a turn of some degrees, counterclockwise, where another one was wanted.

    where: " at corner 3", for example.
    """
    if not wanted:
        return f"pointed {amount(degrees, 'degree')} too far to the {side(degrees)}{where}"
    if degrees * wanted < 0 and abs(degrees) > 10:
        return f"turned to the {side(degrees)}{where}, and not to the {side(wanted)}"
    error = math.copysign(1, wanted) * (degrees - wanted)
    return f"turned {amount(error, 'degree')} too {'far' if error > 0 else 'little'}{where}"


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
