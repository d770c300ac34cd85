"""The sides and corners of a driven polygon."""

import math
from typing import List, NamedTuple, Sequence

from jetbot.kinematics import Pose

from .course import Point
from .recorder import Drive

CORNER = math.radians(45)  # the robot is at a corner when it has turned so far since the side before
SETTLED = 0.1              # m of driving after a corner; then the robot has the heading of the next side


class Side(NamedTuple):
    """A side, from one corner (or the start) to the next one (or the stop).

    length: m, straight from end to end; heading: degrees, not normalized; end: (x, y).
    """

    length: float
    heading: float
    end: Point


def driven_sides(drive: Drive) -> List[Side]:
    """Return the sides that the robot drove: one more than the corners, as the last one ends where the robot stopped.

    Their headings are means over the middle half, so that rounded corners and the last correction do not count.
    """
    pieces = _split(drive.poses)
    return [Side(_distance(piece[0], piece[-1]), math.degrees(_mean_heading(piece)), piece[-1][:2]) for piece in pieces]


def _split(path: Sequence[Pose]) -> List[List[Pose]]:
    """Return the path in pieces that end at corners: halfway through each turn."""
    pieces = [[path[0]]]
    heading, driven = path[0].yaw, 0.0  # of this side, None until it is known; m since the last corner
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
    """Return the pose between two others where the heading was this one, or the nearer of the two."""
    turn = after.yaw - before.yaw
    share = max(0.0, min(1.0, (yaw - before.yaw) / turn)) if turn else 0.0
    return Pose(*(first + share * (last - first) for first, last in zip(before, after)))


def _mean_heading(poses):
    """Return the mean heading over the middle half of a side, in rad; the last one, if the robot drove no side."""
    lengths = [_distance(before, after) for before, after in zip(poses, poses[1:])]
    total = sum(lengths)
    if total < SETTLED:
        return poses[-1].yaw
    low, high = total / 4, total * 3 / 4
    driven = weighted = 0.0
    for before, after, length in zip(poses, poses[1:], lengths):
        in_middle = min(driven + length, high) - max(driven, low)
        if in_middle > 0:
            weighted += in_middle * ((before.yaw + after.yaw) / 2)
        driven += length
    return weighted / (high - low)


def _distance(one, other):
    return math.dist(one[:2], other[:2])
