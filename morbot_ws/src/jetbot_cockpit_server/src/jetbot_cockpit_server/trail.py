"""The trails of the robots on the map. No ROS here."""

import math
from collections import deque
from typing import Deque, Dict, List, Optional, Tuple

Point = Tuple[float, float]

STEP = 0.03       # m between two points of a trail
JUMP = 0.2        # m between two poses that no robot drives: it was put somewhere else;
MAX_SPEED = 1.0   # m/s: and more, if the time between the two was long
RESET_TIME = 0.5  # s until a robot that is put back is at its start
MAX_POINTS = 500  # the oldest are dropped


class Trail:
    """Where one robot has driven."""

    def __init__(self):
        self.points: Deque[Point] = deque(maxlen=MAX_POINTS)
        self._last: Optional[Tuple[Point, float]] = None
        self._reset_until = math.inf

    def reset(self, now: float) -> None:
        """The robot is asked to go back to its start."""
        self._reset_until = now + RESET_TIME

    def update(self, x: float, y: float, now: float) -> bool:
        """The robot is at this point, in m. Return whether the trail starts again, because it was put there."""
        point = x, y
        starts_again = self._has_jumped(point, now) or now >= self._reset_until
        if now >= self._reset_until:
            self._reset_until = math.inf
        self._last = point, now
        if starts_again:
            self.points.clear()
        if not self.points or math.dist(point, self.points[-1]) >= STEP:
            self.points.append(point)
        return starts_again

    def _has_jumped(self, point, now):
        if self._last is None:
            return False
        last, at = self._last
        return math.dist(point, last) > JUMP + MAX_SPEED * (now - at)


class Trails:
    """The trails of all robots, as messages of the cockpit's socket."""

    def __init__(self):
        self._trails: Dict[str, Trail] = {}

    def reset(self, robot: str, now: float) -> None:
        """The robot is asked to go back to its start: its trail starts again there, however near that is."""
        if robot in self._trails:
            self._trails[robot].reset(now)

    def update(self, poses: Dict[str, Optional[Tuple[float, float, float]]], now: float) -> List[dict]:
        """Take the poses (x, y, yaw) of all robots; return a message for each trail that starts again."""
        self._trails = {robot: self._trails.get(robot) or Trail() for robot in poses}
        return [message(robot, []) for robot, pose in poses.items()
                if pose and self._trails[robot].update(*pose[:2], now)]

    def messages(self) -> List[dict]:
        """Return a message for each trail."""
        return [message(robot, trail.points) for robot, trail in self._trails.items()]


def message(robot: str, points) -> dict:
    return {"type": "trail", "robot": robot, "points": [list(point) for point in points]}
