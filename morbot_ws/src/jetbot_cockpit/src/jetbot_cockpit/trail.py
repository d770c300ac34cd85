"""The trails of the robots on the map. No ROS here."""

import math
from collections import deque
from typing import Deque, Dict, List, Optional, Tuple

Point = Tuple[float, float]

STEP = 0.03       # m between two points of a trail
JUMP = 0.2        # m between two poses that no robot drives: it was put somewhere else
MAX_POINTS = 500  # the oldest are dropped


class Trail:
    """Where one robot has driven."""

    def __init__(self):
        self.points: Deque[Point] = deque(maxlen=MAX_POINTS)
        self._last: Optional[Point] = None

    def update(self, x: float, y: float) -> bool:
        """The robot is at this point, in m. Return whether the trail starts again, because it was put there."""
        point = x, y
        jumped = self._last is not None and math.dist(point, self._last) > JUMP
        self._last = point
        if jumped:
            self.points.clear()
        if not self.points or math.dist(point, self.points[-1]) >= STEP:
            self.points.append(point)
        return jumped


class Trails:
    """The trails of all robots, as messages of the cockpit's socket."""

    def __init__(self):
        self._trails: Dict[str, Trail] = {}

    def update(self, poses: Dict[str, Optional[Tuple[float, float, float]]]) -> List[dict]:
        """Take the poses (x, y, yaw) of all robots; return a message for each trail that starts again."""
        self._trails = {robot: self._trails.get(robot) or Trail() for robot in poses}
        return [message(robot, []) for robot, pose in poses.items() if pose and self._trails[robot].update(*pose[:2])]

    def messages(self) -> List[dict]:
        """Return a message for each trail."""
        return [message(robot, trail.points) for robot, trail in self._trails.items()]


def message(robot: str, points) -> dict:
    return {"type": "trail", "robot": robot, "points": [list(point) for point in points]}
