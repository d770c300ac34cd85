"""The ideal line of a task: straights, arcs and turns, each with a closed form."""

import math
from typing import List, NamedTuple, Sequence, Tuple, Union

from jetbot.kinematics import Point, Pose, to_frame

SPACING = 0.01  # m between two points of a line
TURN_SPEED = 90.0  # degrees per second, of a turn on the spot


class Straight(NamedTuple):
    """Drive straight ahead for ``length`` metres."""

    length: float
    degrees: float = 0.0


class Turn(NamedTuple):
    """Turn on the spot, counterclockwise if ``degrees`` is positive."""

    degrees: float
    length: float = 0.0


class Arc(NamedTuple):
    """Drive forward on a circle of ``radius`` metres, to the left if ``degrees`` is positive."""

    radius: float
    degrees: float

    @property
    def length(self) -> float:
        """How far the robot drives, in m."""
        return self.radius * math.radians(abs(self.degrees))


Step = Union[Straight, Turn, Arc]


def s_bend(length: float, offset: float) -> Tuple[Arc, Arc]:
    """Return the two equal arcs that lead to (length, offset, 0) in m."""
    angle = 2 * math.atan(offset / length)
    radius = length / (2 * math.sin(abs(angle)))
    return Arc(radius, math.degrees(angle)), Arc(radius, -math.degrees(angle))


def advance(pose: Pose, step: Step, share: float = 1.0) -> Pose:
    """Return where a robot at ``pose`` is after a share, in [0, 1], of a step. The heading is not normalized."""
    return pose.advance(step.length * share, math.radians(step.degrees) * share)


class Course(NamedTuple):
    """Steps that start at (0, 0, 0)."""

    steps: Tuple[Step, ...]

    @property
    def poses(self) -> List[Pose]:
        """Where each step starts, and last the goal."""
        poses = [Pose()]
        for step in self.steps:
            poses.append(advance(poses[-1], step))
        return poses

    @property
    def goal(self) -> Pose:
        """Where the course ends. The heading is not normalized: after a full circle it is 2 pi."""
        return self.poses[-1]

    @property
    def points(self) -> Tuple[Point, ...]:
        """The line as points that are at most 1 cm apart."""
        points = [(0.0, 0.0)]
        for pose, step in zip(self.poses, self.steps):
            count = math.ceil(round(step.length / SPACING, 6))
            points += [advance(pose, step, number / count)[:2] for number in range(1, count + 1)]
        return tuple(points)

    def seconds(self, speed: float) -> float:
        """Return how long the course takes at ``speed`` in m/s, with turns at TURN_SPEED."""
        return sum(step.length / speed if step.length else abs(step.degrees) / TURN_SPEED for step in self.steps)

    def offsets(self, points: Sequence[Point]) -> List[float]:
        """Return how far each point is from the line, in m; positive if it is left of the line."""
        steps = list(zip(self.poses, self.steps))
        return [min((_offset(pose, step, point) for pose, step in steps), key=abs) for point in points]


def relative(pose: Pose, frame: Pose) -> Pose:
    """Return where a pose is as seen from ``frame``: x ahead, y to the left. The heading is not normalized."""
    return Pose(*to_frame(frame, pose[:2]), pose.yaw - frame.yaw)


def _offset(start, step, point):
    """Return how far a point is from a step that starts at this pose, in m; positive if it is left of the step."""
    x, y = to_frame(start, point)
    if isinstance(step, Arc):
        return _offset_from_arc(step, x, y)
    return math.copysign(math.hypot(x - max(0.0, min(step.length, x)), y), y)


def _offset_from_arc(arc, x, y):
    side = math.copysign(1.0, arc.degrees)  # the centre is at (0, side * radius)
    y *= side                               # as if the arc went to the left
    angle = math.degrees(math.atan2(x, arc.radius - y)) % 360  # how far along the arc the point is
    if angle <= abs(arc.degrees):
        return side * (arc.radius - math.hypot(x, arc.radius - y))
    end = advance(Pose(), Arc(arc.radius, abs(arc.degrees)))
    nearest = min(Pose(), end, key=lambda pose: math.hypot(x - pose.x, y - pose.y))
    _, left = to_frame(nearest, (x, y))
    return side * math.copysign(math.hypot(x - nearest.x, y - nearest.y), left)
