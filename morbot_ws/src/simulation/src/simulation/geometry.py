"""Points, segments and rectangles on the floor, in metres."""

import math
from typing import NamedTuple, Tuple

from jetbot.kinematics import Point


class Rectangle(NamedTuple):
    """A rectangle along the axes, between two corners."""

    left: float
    bottom: float
    right: float
    top: float

    @property
    def corners(self) -> Tuple[Point, ...]:
        """The four corners."""
        return ((self.left, self.bottom), (self.left, self.top), (self.right, self.bottom), (self.right, self.top))

    def distance(self, start: Point, end: Point) -> float:
        """Return the distance to a segment, 0.0 if they touch or the segment is inside."""
        if self.meets(start, end):
            return 0.0
        return min(self.distance_to_point(start), self.distance_to_point(end),
                   *(distance_to_segment(corner, start, end) for corner in self.corners))

    def distance_to_point(self, point: Point) -> float:
        """Return the distance to a point, 0.0 if it is inside."""
        x, y = point
        return math.hypot(max(self.left - x, 0.0, x - self.right), max(self.bottom - y, 0.0, y - self.top))

    def meets(self, start: Point, end: Point) -> bool:
        """Return whether a segment has a point inside or on the edge: Liang and Barsky's clipping."""
        enters, leaves = 0.0, 1.0
        for a, b, low, high in ((start[0], end[0], self.left, self.right), (start[1], end[1], self.bottom, self.top)):
            if a == b:
                if not low <= a <= high:
                    return False
                continue
            first, last = sorted(((low - a) / (b - a), (high - a) / (b - a)))
            enters, leaves = max(enters, first), min(leaves, last)
        return enters <= leaves


def distance_to_segment(point: Point, start: Point, end: Point) -> float:
    """Return the distance of a point from a segment."""
    (x, y), (start_x, start_y) = point, start
    along_x, along_y = end[0] - start_x, end[1] - start_y
    length = along_x * along_x + along_y * along_y
    part = ((x - start_x) * along_x + (y - start_y) * along_y) / length if length else 0.0
    part = max(0.0, min(1.0, part))
    return math.hypot(x - start_x - part * along_x, y - start_y - part * along_y)


def distance_beyond(point: Point, start: Point, end: Point) -> float:
    """Return how far a point is beyond the end of a segment, in its direction; negative before it."""
    x, y = end[0] - start[0], end[1] - start[1]
    length = math.hypot(x, y)
    return ((point[0] - end[0]) * x + (point[1] - end[1]) * y) / length if length else -math.inf
