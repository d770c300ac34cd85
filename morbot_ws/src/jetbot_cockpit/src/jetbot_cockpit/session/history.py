"""What is kept of the robots for pages that open later, as messages of the socket: trails, scenes and scores."""

import math
from collections import deque
from typing import Any, Callable, Deque, Dict, Iterable, List, NamedTuple, Optional, Tuple

from jetbot.kinds import is_number

from .snapshot import RobotSnapshot, Shape, TaskSnapshot, label

STEP = 0.03       # m between two points of a trail
JUMP = 0.2        # m between two poses that no robot drives: it was put somewhere else;
MAX_SPEED = 1.0   # m/s: and more, if the time between the two was long
RESET_TIME = 0.5  # s until a robot that is put back is at its start
MAX_POINTS = 500  # of a trail; the oldest are dropped


class Trail:
    """Where one robot has driven. start: its first (x, y, yaw), in m and rad."""

    def __init__(self):
        self.start: Optional[Tuple[float, float, float]] = None
        self.points: Deque[Tuple[float, float]] = deque(maxlen=MAX_POINTS)
        self._last: Optional[Tuple[float, float]] = None
        self._at, self._reset_at = 0.0, math.inf

    def reset(self, now: float) -> None:
        """The robot is asked to go back to its start: the trail starts again there, however near that is."""
        self._reset_at = now + RESET_TIME

    def update(self, pose: Tuple[float, float, float], now: float) -> bool:
        """The robot is at this pose, in m and rad. Return whether the trail starts again: it was put there."""
        point = pose[:2]
        starts_again = now >= self._reset_at or self._has_jumped(point, now)
        if starts_again:
            self.points.clear()
        if starts_again or self.start is None:
            self.start = pose
        if now >= self._reset_at:
            self._reset_at = math.inf
        self._last, self._at = point, now
        if not self.points or math.dist(point, self.points[-1]) >= STEP:
            self.points.append(point)
        return starts_again

    def _has_jumped(self, point, now):
        return self._last is not None and math.dist(point, self._last) > JUMP + MAX_SPEED * (now - self._at)


class Score(NamedTuple):
    """A row of the class's best. task: its title; robot: the robot's label; score: 0 to 100; seconds: of the drive;
    name: of who drove, "" if it is not known.
    """

    task: str
    robot: str
    score: float
    seconds: Optional[float]
    name: str = ""

    @property
    def rank(self) -> Tuple[float, float]:
        """Is smaller for the better of two in one task: points count, then the time, which a drive may not have."""
        return -self.score, math.inf if self.seconds is None else self.seconds


class Scores:
    """The best of each robot in each task. kept: what ``keep`` was called with, after the last change."""

    def __init__(self, kept: Iterable[Any] = (), keep: Callable[[List[list]], None] = lambda rows: None):
        self._best: Dict[Tuple[str, str], Score] = {  # by robot and name of the task
            tuple(row[:2]): Score(*row[2:]) for row in kept if is_score(row)}
        self._keep = keep

    def add(self, robot: str, task: Optional[TaskSnapshot]) -> bool:
        """Take a robot's task; return whether that is a better score."""
        if not task or task.score is None:
            return False
        key, score = (robot, task.name), Score(task.title, label(robot), task.score, task.seconds, task.driver)
        if key in self._best and score.rank >= self._best[key].rank:
            return False
        self._best[key] = score
        self._keep([[*key, *best] for key, best in self._best.items()])
        return True

    def messages(self) -> List[dict]:
        """Return the message with all scores, the best of each task first; none before the first score."""
        rows = sorted(self._best.values(), key=lambda row: (row.task, row.rank, row.robot))
        return [{"type": "scores", "scores": [row._asdict() for row in rows]}] if rows else []


def is_score(row: Any) -> bool:
    """Return whether this is a robot's id, the name of a task, and the values of a Score."""
    return (isinstance(row, list) and len(row) == 7 and all(isinstance(row[each], str) for each in (0, 1, 2, 3, 6))
            and is_number(row[4]) and (row[5] is None or is_number(row[5])))


class History:
    """All of it, by the robots' ids."""

    def __init__(self, scores: Optional[Scores] = None):
        self._trails: Dict[str, Trail] = {}
        self._forgotten: Dict[str, Optional[TaskSnapshot]] = {}
        self._scenes: Dict[str, Tuple[Shape, ...]] = {}
        self._scores = scores or Scores()

    def reset(self, robot: str, now: float) -> None:
        """The robot is asked to go back to its start."""
        if robot in self._trails:
            self._trails[robot].reset(now)

    def task(self, robot: RobotSnapshot) -> Optional[TaskSnapshot]:
        """Return the robot's task; not the result of a drive after which it was put somewhere else."""
        return None if robot.task is self._forgotten.get(robot.id) else robot.task

    def forget_task(self, robot: RobotSnapshot) -> None:
        """The robot gets another task: what is still shown of the last one is over."""
        self._forgotten[robot.id] = robot.task

    def update(self, robots: Dict[str, RobotSnapshot], now: float) -> List[dict]:
        """Take all robots as they are now; return messages with what has changed. now: in monotonic seconds."""
        self._trails = {robot: self._trails.get(robot) or Trail() for robot in robots}
        restarts = [robot for robot in robots.values()
                    if robot.pose and self._trails[robot.id].update(robot.pose, now)]
        self._forgotten.update((each.id, each.task) for each in restarts if each.task and each.task.state == "done")
        before, self._scenes = self._scenes, {robot.id: self._scene(robot) for robot in robots.values()}
        scenes = [scene(robot, shapes) for robot, shapes in self._scenes.items() if shapes != before.get(robot, ())]
        better = [self._scores.add(robot.id, robot.task) for robot in robots.values()]
        trails = [trail(robot.id, robot.pose, []) for robot in restarts]
        return trails + scenes + (self._scores.messages() if any(better) else [])

    def _scene(self, robot: RobotSnapshot) -> Tuple[Shape, ...]:
        """Return what is drawn around the robot: a course only with its task."""
        return tuple(shape for shape in robot.shapes if self.task(robot) or shape.kind not in ("course", "goal"))

    def messages(self) -> List[dict]:
        """Return messages with all of it; also of an empty scene: a page may have missed that it is gone."""
        return ([trail(robot, each.start, each.points) for robot, each in self._trails.items()]
                + [scene(robot, shapes) for robot, shapes in self._scenes.items()] + self._scores.messages())


def trail(robot: str, start, points) -> dict:
    return {"type": "trail", "robot": robot, "start": start and list(start), "points": list(map(list, points))}


def scene(robot: str, shapes: Tuple[Shape, ...]) -> dict:
    return {"type": "scene", "robot": robot, "shapes": [shape._asdict() for shape in shapes]}
