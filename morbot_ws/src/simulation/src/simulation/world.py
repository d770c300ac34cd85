"""What a simulated robot drives among: walls that stop it, and dark lines on the light floor. No ROS.

All lengths are in metres.
"""

import math
from itertools import chain
from typing import Iterator, NamedTuple, Sequence, Tuple

from jetbot.kinematics import Point, Pose, from_frame, to_frame

Polyline = Tuple[Point, ...]

LINE_WIDTH = 0.025   # m; common tape is 19 to 25 mm wide
SPOT_RADIUS = 0.005  # m, of the floor that a reflectance sensor lights
EYES = {"left": (0.05, 0.015), "middle": (0.05, 0.0), "right": (0.05, -0.015)}  # in the robot's own frame


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


FOOTPRINT = Rectangle(-0.095, -0.0625, 0.035, 0.0625)  # of the robot in its own frame; case and tyres of the URDF
RADIUS = max(math.hypot(*corner) for corner in FOOTPRINT.corners)  # of the circle around the axle that holds it


class World(NamedTuple):
    """walls, lines: polylines, each of two points (x, y) or more.

    A wall is thin: the robot touches the line that is written.
    """

    walls: Tuple[Polyline, ...] = ()
    lines: Tuple[Polyline, ...] = ()
    line_width: float = LINE_WIDTH

    def placed(self, pose: Pose) -> "World":
        """Return this world with its origin at a pose."""
        walls, lines = (tuple(tuple(from_frame(pose, point) for point in polyline) for polyline in polylines)
                        for polylines in (self.walls, self.lines))
        return World(walls, lines, self.line_width)

    def clearance(self, pose: Pose) -> float:
        """Return the distance from the robot at this pose to the nearest wall.

        0.0 where it touches a wall or is on one, ``math.inf`` without walls.
        """
        centre, nearest = (pose.x, pose.y), math.inf
        for start, end in segments(self.walls):
            if distance_to_segment(centre, start, end) - RADIUS < nearest:
                nearest = min(nearest, FOOTPRINT.distance(to_frame(pose, start), to_frame(pose, end)))
        return nearest

    def line_sensor(self, pose: Pose) -> Tuple[float, ...]:
        """Return what the EYES below the front of the robot at this pose see: each the ``reflectance`` below it."""
        return tuple(self.reflectance(*from_frame(pose, eye)) for eye in EYES.values())

    def reflectance(self, x: float, y: float) -> float:
        """Return what a sensor above this point sees: 0 is a dark line, 1 the light floor, 0.5 a line's edge."""
        outside = min((self._outside((x, y), line) for line in self.lines), default=math.inf)
        return max(0.0, min(1.0, 0.5 + outside / (2 * SPOT_RADIUS)))

    def _outside(self, point: Point, line: Polyline) -> float:
        """Return the distance of a point from the edge of a line, negative inside. Its joints are round, its ends not.

        A line that leads back to its start has no ends.
        """
        distances = [distance_to_segment(point, *segment) - self.line_width / 2 for segment in segments([line])]
        if line[0] != line[-1]:
            distances[0] = max(distances[0], distance_beyond(point, line[1], line[0]))
            distances[-1] = max(distances[-1], distance_beyond(point, line[-2], line[-1]))
        return min(distances)


EMPTY = World()


def segments(polylines: Sequence[Polyline]) -> Iterator[Tuple[Point, Point]]:
    """Return the segments of all polylines, each as its two ends."""
    return chain.from_iterable(zip(polyline, polyline[1:]) for polyline in polylines)


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
