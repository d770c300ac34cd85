"""What a task measures: each measure returns errors in cm or degrees, each with a sentence and its place."""

import math
from statistics import fmean
from typing import Callable, List, NamedTuple, Sequence

from jetbot.sentence import Sentence
from simulation.world import distance_to_segment

from .course import SPACING, Course, Point, Straight, Turn, relative
from .polygon import driven_sides
from .recorder import Drive
from .sentences import say, with_average

MOVING = 0.01      # m/s; a robot that is slower has stopped
TOLERANCE = 10.0   # cm or degrees of error that leave 1/e of the points
SQUARE = 0.25      # m, of the floor
MAX_POINTS = 1000  # of a resampled path: a longer one has fewer points per metre


class Error(NamedTuple):
    """size: in cm or degrees; sentence: what the robot did, without a full stop; place: (x, y) in the task's frame.

    has_mean: whether the mean of several such errors has a meaning.
    """

    size: float
    sentence: Sentence
    place: Point
    has_mean: bool = False


Measure = Callable[[Course, Drive], List[Error]]


def end(course: Course, drive: Drive) -> List[Error]:
    """Return how far the robot stopped from the goal, or how wrong its heading was there: the larger of the two."""
    goal, stop = course.goal, drive.end
    seen = relative(stop, goal)
    distance, turn = 100 * math.hypot(seen.x, seen.y), math.degrees(seen.yaw)
    if abs(turn) > distance:
        sentence = describe_last_turn(math.degrees(stop.yaw), math.degrees(goal.yaw))
    else:
        end = "still_driving" if abs(drive.path[-1].speed) > MOVING else "stopped"
        sentence = _describe_stop(end, 100 * seen.x, 100 * seen.y)
    return [Error(max(distance, abs(turn)), sentence, stop[:2])]


def line(course: Course, drive: Drive) -> List[Error]:
    """Return how far the driven path and the course are apart: a mean in cm over the path, or over the course.

    The larger of the two: the one sees a path that leaves the line, the other a part of the line that was left out.
    """
    path = resample([pose[:2] for pose in drive.poses])
    offsets = [100 * offset for offset in course.offsets(path)]
    gaps = [100 * distance for distance in distances(course.points, path)]
    off, missed = fmean(map(abs, offsets)), fmean(gaps)
    if missed > 2 * off:
        largest, place = max(zip(gaps, course.points))
        return [Error(missed, say("part_missed", distance=amount(largest)), place)]
    largest, place = max(zip(offsets, path), key=lambda each: abs(each[0]))
    beyond = min(math.dist(place, tip) for tip in (course.points[0], course.points[-1])) <= abs(largest) / 100 + 0.001
    code = "off_line" if beyond else f"off_line_{left_or_right(largest)}"
    sentence = say(code, mean=amount(off), worst=amount(largest))
    return [Error(max(off, missed), sentence, place)]


def sides(course: Course, drive: Drive) -> List[Error]:
    """Return how much longer or shorter each side is than it should be; a missing one counts whole."""
    wanted, driven = [step.length for step in course.steps if isinstance(step, Straight)], driven_sides(drive)
    errors = []
    for number, (length, side) in enumerate(zip(wanted, driven), 1):
        error = 100 * (side.length - length)
        sentence = say(f"drove_{extent(error)}", distance=amount(error), side=number)
        errors.append(_missing(abs(error), number, drive) if side is driven[-1] else
                      Error(abs(error), sentence, side.end, has_mean=True))
    errors += [_missing(100 * length, len(driven), drive) for length in wanted[len(driven):]]
    beyond = 100 * sum(side.length for side in driven[len(wanted):])
    if beyond > errors[-1].size:  # it belongs to the last side
        errors[-1] = Error(beyond, say("drove_on", distance=amount(beyond), corner=len(wanted)), drive.end[:2])
    return errors


def corners(course: Course, drive: Drive) -> List[Error]:
    """Return how much too far or too little the robot turned at each corner; a missing one counts whole.

    The last turn leads to the heading at the stop.
    """
    wanted, driven = [step.degrees for step in course.steps if isinstance(step, Turn)], driven_sides(drive)
    headings = [side.heading for side in driven[:len(wanted)]]
    if len(driven) > len(wanted):
        headings.append(math.degrees(drive.end.yaw))
    errors = []
    for number, (degrees, side, before, after) in enumerate(zip(wanted, driven, headings, headings[1:]), 1):
        turn = after - before
        sentence = describe_turn(turn, degrees, number)
        errors.append(Error(abs(turn - degrees), sentence, side.end, has_mean=turn * degrees > 0))
    return errors + [_missing(abs(degrees), len(driven), drive) for degrees in wanted[len(errors):]]


def squares(_: Course, drive: Drive, wanted: int) -> List[Error]:
    """Return an error that leaves as large a part of the points as the robot was in of the squares that are wanted.

    Where its axle's middle was counts, beside the square in whose middle it starts.
    """
    seen = {(round(pose.x / SQUARE), round(pose.y / SQUARE)) for pose in drive.poses} - {(0, 0)}
    size = TOLERANCE * math.log(wanted / min(wanted, len(seen))) if seen else math.inf
    return [Error(size, say("squares", count=len(seen), wanted=wanted), drive.end[:2])]


def _missing(size, corner, drive):
    """Return the error for what a drive lacks that ended before a corner, which has this number."""
    return Error(size, say("stopped_before_corner", corner=corner), drive.end[:2])


def resample(points: Sequence[Point]) -> List[Point]:
    """Return a path as points that are 1 cm apart, or MAX_POINTS of them; first and last as they are."""
    spacing = max(SPACING, sum(map(math.dist, points, points[1:])) / MAX_POINTS)
    result, ahead = [points[0]], spacing  # m from the start of a segment to the next point
    for start, stop in zip(points, points[1:]):
        length = math.dist(start, stop)
        while ahead <= length:
            share = ahead / length
            result.append((start[0] + share * (stop[0] - start[0]), start[1] + share * (stop[1] - start[1])))
            ahead += spacing
        ahead -= length
    return [*result, points[-1]]


def distances(points: Sequence[Point], path: Sequence[Point]) -> List[float]:
    """Return how far each point is from a path, in m."""
    segments = list(zip(path, path[1:]))
    return [min(distance_to_segment(point, *segment) for segment in segments) for point in points]


def worst(errors: Sequence[Error]) -> Error:
    """Return the largest error; the first of those that are about as large."""
    largest = max(error.size for error in errors)
    return next(error for error in errors if error.size >= 0.95 * largest)


def describe(error: Error, mean: float, count: int) -> Sentence:
    """Return a sentence about the worst of so many errors, and about their mean unless that one is most of it."""
    widespread = error.has_mean and error.size < count * mean / 2
    return with_average(error.sentence, amount(mean)) if widespread else error.sentence


def describe_turn(degrees: float, wanted: float, corner: int) -> Sentence:
    """Return what is wrong with the turn at a corner of some degrees, counterclockwise, where others were wanted."""
    if is_opposite(degrees, wanted):
        return say(f"turned_{left_or_right(degrees)}_corner", corner=corner)
    error = math.copysign(1, wanted) * (degrees - wanted)
    return say(f"turned_{extent(error)}_corner", count=amount(error), corner=corner)


def describe_last_turn(degrees: float, wanted: float) -> Sentence:
    """Return what is wrong with the heading at the end; both in degrees from that of the start."""
    if not wanted:
        return say(f"pointed_{left_or_right(degrees)}", count=amount(degrees))
    if is_opposite(degrees, wanted):
        return say(f"turned_{left_or_right(degrees)}")
    error = math.copysign(1, wanted) * (degrees - wanted)
    return say(f"turned_{extent(error)}", count=amount(error))


def _describe_stop(end, ahead, left):
    """Return where the robot is, in cm, as seen from the goal; the smaller distance only if it is half the larger.

    end: a code of ENDS.
    """
    way, side = "past" if ahead > 0 else "short", left_or_right(left)
    smaller, larger = sorted([abs(ahead), abs(left)])
    if 2 * smaller >= larger > 0:
        return say(f"{end}_{way}_{side}", ahead=amount(ahead), across=amount(left))
    return say(f"{end}_{way}", ahead=amount(ahead)) if abs(ahead) >= abs(left) else \
        say(f"{end}_{side}", across=amount(left))


def is_opposite(degrees: float, wanted: float) -> bool:
    """Return whether a robot turned the other way than it should have."""
    return degrees * wanted < 0 and abs(degrees) > 10


def extent(error: float) -> str:
    """Return the code of too much or of too little: of EXTENTS."""
    return "too_far" if error > 0 else "too_little"


def left_or_right(value: float) -> str:
    """Return left for a positive offset or turn, else right."""
    return "left" if value > 0 else "right"


def amount(value: float) -> str:
    """Return a size for people: 4.8, or 12."""
    number = f"{abs(value):.1f}" if abs(value) < 9.95 else f"{abs(value):.0f}"
    return number[:-2] if number.endswith(".0") else number
