"""The sides and corners of a driven polygon."""

import math
from typing import List, NamedTuple, Tuple

from jetbot.kinematics import Pose

from .course import Point
from .drive import Drive

CORNER = math.radians(45)  # the robot is at a corner when it has turned so far since the side before
SETTLED = 0.1              # m of driving after a corner; then the robot has the heading of the next side


class Side(NamedTuple):
    """A side, from one corner (or the start) to the next one (or the stop).

    length: m, straight from end to end; heading: degrees, not normalized; end: (x, y).
    """

    length: float
    heading: float
    end: Point


def sides(drive: Drive) -> List[Side]:
    """Return the sides that the robot drove: one more than the corners, as the last one ends where the robot stopped.

    Their headings are means over the middle half, so that rounded corners and the last correction do not count.
    """
    return [_side(poses) for poses in _split([sample.pose for sample in drive.path])]


def _split(path: List[Pose]) -> List[List[Pose]]:
    """Return the path in pieces that end at corners: halfway through each turn."""
    pieces, heading, driven = [[path[0]]], path[0].yaw, 0.0
    for before, after in zip(path, path[1:]):
        driven += _distance(before, after)
        if heading is None and driven >= SETTLED:
            heading = after.yaw
        if heading is not None and abs(after.yaw - heading) >= CORNER:
            corner = _between(before, after, heading + math.copysign(CORNER, after.yaw - heading))
            pieces[-1].append(corner)
            pieces.append([corner])
            heading, driven = None, 0.0
        pieces[-1].append(after)
    return pieces


def _between(before, after, yaw):
    """Return the pose between two others, where the heading was this one."""
    share = max(0.0, min(1.0, (yaw - before.yaw) / (after.yaw - before.yaw))) if after.yaw != before.yaw else 0.0
    return Pose(*(first + share * (last - first) for first, last in zip(before, after)))


def _side(poses):
    return Side(_distance(poses[0], poses[-1]), math.degrees(_heading(poses)), poses[-1][:2])


def _heading(poses):
    """Return the mean heading of the middle half of a side; the last one, if the robot drove no side."""
    steps: List[Tuple[float, float, float]] = []  # from, to (m driven since the corner), heading
    driven = 0.0
    for before, after in zip(poses, poses[1:]):
        start, driven = driven, driven + _distance(before, after)
        steps.append((start, driven, (before.yaw + after.yaw) / 2))
    if driven < SETTLED:
        return poses[-1].yaw
    low, high = driven / 4, driven * 3 / 4
    return sum(max(0.0, min(end, high) - max(start, low)) * yaw for start, end, yaw in steps) / (high - low)


def _distance(one, other):
    return math.hypot(one.x - other.x, one.y - other.y)
