"""The driving task of a robot, as its judge reports it. No ROS and no clock here: times are monotonic seconds."""

import math
from typing import Mapping, NamedTuple, Optional

from jetbot.text import printable

DRIVING, DONE = "driving", "done"
STATES = ("ready", DRIVING, DONE, "cancelled")
ENDED = (DONE, "cancelled")
GONE_AFTER = 3.0    # s without a publisher until a task without a score is forgotten: its judge was killed
SILENT_AFTER = 5.0  # s without a message until a drive is forgotten: its judge is frozen
MAX_TITLE = 60      # characters
MAX_TEXT = 200      # characters
MAX_SECONDS = 1e5


class Task(NamedTuple):
    """A task at one moment. text: a sentence for the person; seconds: of the drive; score: 0 to 100, once done."""

    name: str
    title: str
    state: str
    text: str
    seconds: Optional[float] = None
    score: Optional[float] = None


def decode(name: str, text: str, values: Mapping[str, str]) -> Optional[Task]:
    """Return the task that a DiagnosticStatus reports, with its values by key; None if it is no task's."""
    state = values.get("state")
    if not name or state not in STATES:
        return None
    score = number(values.get("score"), 100.0) if state == DONE else None
    return Task(printable(name)[:MAX_TITLE], printable(values.get("title") or name)[:MAX_TITLE], state,
                printable(text)[:MAX_TEXT], number(values.get("seconds"), MAX_SECONDS), score)


def number(text: Optional[str], largest: float) -> Optional[float]:
    """Return the number, with one decimal; None if the text is no number from 0 to the largest."""
    try:
        value = float(text)
    except (TypeError, ValueError):
        return None
    return round(value, 1) + 0.0 if 0 <= value <= largest else None


class TaskTracker:
    """Decides how long a robot's task is shown. ``update`` may be called by another thread."""

    def __init__(self):
        self._task: Optional[Task] = None
        self._forgotten: Optional[Task] = None
        self._updated_at = self._connected_at = -math.inf

    def update(self, task: Optional[Task], now: float) -> None:
        """Take what a judge has reported."""
        self._updated_at = self._connected_at = now
        self._task = task

    def forget_result(self) -> None:
        """The robot was put back to its start: a result is no longer shown."""
        task = self._task
        if task and task.state in ENDED:
            self._forgotten = task

    def current(self, connected: bool, now: float) -> Optional[Task]:
        """Return the task that is shown now, or None. connected: whether a judge publishes."""
        task = self._task
        if connected:
            self._connected_at = now
        if task and task.state != DONE:
            gone = now - self._connected_at > GONE_AFTER
            silent = task.state == DRIVING and now - self._updated_at > SILENT_AFTER
            if gone or silent:
                self._forgotten = task
        return None if task is self._forgotten else task
