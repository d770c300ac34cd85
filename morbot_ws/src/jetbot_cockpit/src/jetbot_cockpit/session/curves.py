"""What the curves of one page are sent: all that a robot reports, each value with its time."""

from typing import Callable, Optional

TOPICS = "odom", "wheels", "line", "battery"  # fields of the message "curves"


class Curves:
    """robot: whose values the page draws, None: nobody's."""

    def __init__(self):
        self.robot: Optional[str] = None
        self._number: Optional[int] = None

    def follow(self, robot: Optional[str]) -> None:
        """The page draws this robot's values from now on."""
        self.robot, self._number = robot, None

    def next(self, readings: Callable) -> Optional[dict]:
        """Return the message with what is new, or None. readings: robots.discovery.Robots.readings."""
        found = None if self.robot is None else readings(self.robot, self._number)
        if not found:
            return None
        is_first, (now, (after, self._number, rows)) = self._number is None, found
        return {"type": "curves", "robot": self.robot, "now": now, "after": after, "number": self._number,
                **{topic: rows.get(topic, []) for topic in TOPICS}} if rows or is_first else None
