"""The best score of each robot in each task. No ROS here."""

from typing import Dict, List, Mapping, NamedTuple, Optional, Tuple

from .task import Task
from .view import label

MAX_SCORES = 500  # the oldest are dropped


class Score(NamedTuple):
    """A row of the class's best. task: its title; robot: the robot's label; score: 0 to 100; seconds: of the drive."""

    task: str
    robot: str
    score: float
    seconds: Optional[float]


class Scores:
    """The best of each robot in each task, as a message of the cockpit's socket."""

    def __init__(self):
        self._best: Dict[Tuple[str, str], Score] = {}  # by robot and name of the task

    def update(self, tasks: Mapping[str, Optional[Task]]) -> List[dict]:
        """Take the tasks of all robots; return a message if one has become better."""
        better = [self._add(robot, task) for robot, task in tasks.items() if task and task.score is not None]
        return self.messages() if any(better) else []

    def messages(self) -> List[dict]:
        """Return the message with all scores, the best of each task first; none before the first score."""
        rows = sorted(self._best.values(), key=lambda row: (row.task, -row.score, seconds_of(row), row.robot))
        return [{"type": "scores", "scores": [row._asdict() for row in rows]}] if rows else []

    def _add(self, robot, task):
        key, score = (robot, task.name), Score(task.title, label(robot), task.score, task.seconds)
        if key in self._best and rank(score) <= rank(self._best[key]):
            return False
        self._best.pop(key, None)
        self._best[key] = score
        if len(self._best) > MAX_SCORES:
            del self._best[next(iter(self._best))]
        return True


def rank(score: Score) -> Tuple[float, float]:
    """Return what is larger for the better of two scores in one task: points count, then the shorter time."""
    return score.score, -seconds_of(score)


def seconds_of(score: Score) -> float:
    """Return the time in s; a drive without one comes last."""
    return float("inf") if score.seconds is None else score.seconds
