"""What a simulated robot drives among: walls that stop it, and dark lines on the light floor. No ROS."""

import math
from itertools import chain
from typing import Iterator, NamedTuple, Sequence, Tuple

from jetbot.kinematics import Point, Pose, from_frame, to_frame

from .geometry import Rectangle, distance_beyond, distance_to_segment

Polyline = Tuple[Point, ...]

FOOTPRINT = Rectangle(-0.095, -0.0625, 0.035, 0.0625)  # of the robot in its own frame, m; case and tyres of the URDF
RADIUS = max(math.hypot(*corner) for corner in FOOTPRINT.corners)  # of the circle around the axle that holds it, m
LINE_WIDTH = 0.025   # m; common tape is 19 to 25 mm wide
SPOT_RADIUS = 0.005  # m, of the floor that a reflectance sensor lights


class World(NamedTuple):
    """walls, lines: polylines, each of two points (x, y) or more, in m; line_width: m.

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
        """Return the distance in m from the robot at this pose to the nearest wall.

        0.0 where it touches a wall or is on one, ``math.inf`` without walls.
        """
        centre, nearest = (pose.x, pose.y), math.inf
        for start, end in segments(self.walls):
            if distance_to_segment(centre, start, end) - RADIUS < nearest:
                nearest = min(nearest, FOOTPRINT.distance(to_frame(pose, start), to_frame(pose, end)))
        return nearest

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


def segments(polylines: Sequence[Polyline]) -> Iterator[Tuple[Point, Point]]:
    """Return the segments of all polylines, each as its two ends."""
    return chain.from_iterable(zip(polyline, polyline[1:]) for polyline in polylines)


EMPTY = World()
