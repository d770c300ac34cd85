"""Which robots come and go, as lines for the terminal. No clock here: times are monotonic seconds."""

from typing import Dict, List, Mapping

from jetbot.text import enumeration

from .view import Robot

NO_ROBOT_AFTER = 5.0  # s after the start until the lack of robots is reported
NO_ROBOT = "No robot is running. Start one: roslaunch jetbot_control_node jetbot_controller.launch"


class Attendance:
    """The robots that are on the page. now: the time of the start."""

    def __init__(self, now: float):
        self._answering: Dict[str, bool] = {}
        self._lack_is_due = now + NO_ROBOT_AFTER

    def update(self, robots: Mapping[str, Robot], now: float) -> List[str]:
        """Return a sentence for each change since the last call."""
        before, self._answering = self._answering, {robot.label: robot.answers for robot in robots.values()}
        changes = {"on the page": [name for name in self._answering if name not in before],
                   "ended": [name for name in before if name not in self._answering],
                   "not answering": self._changed(before, False),
                   "answering again": self._changed(before, True)}
        lines = [f"{change}: {enumeration(names)}" for change, names in changes.items() if names]
        if robots:
            self._lack_is_due = float("inf")
        elif now >= self._lack_is_due:
            self._lack_is_due = float("inf")
            lines.append(NO_ROBOT)
        return lines

    def _changed(self, before, answers):
        return [name for name, now in self._answering.items() if before.get(name, now) != now == answers]
