"""What the curves of one page are sent: all that a robot reports, each value with its time."""

from typing import Callable, Optional

TOPICS = "odom", "wheels", "line", "battery"  # fields of the message "curves"


class Curves:
    """robot: whose values the page draws, None: nobody's."""

    def __init__(self):
        self.robot: Optional[str] = None
        self._eyes, self._number = False, None

    def follow(self, robot: Optional[str], eyes: bool) -> None:
        """The page draws this robot's values from now on. eyes: also those of its line sensor."""
        self._number = self._number if robot == self.robot else None
        self.robot, self._eyes = robot, eyes

    def next(self, readings: Callable) -> Optional[dict]:
        """Return the message with what is new, or None. readings: robots.discovery.Robots.readings."""
        found = None if self.robot is None else readings(self.robot, self._number, self._eyes)
        if not found:
            return None
        is_first, (now, (after, self._number, rows)) = self._number is None, found
        return {"type": "curves", "robot": self.robot, "now": now, "after": after, "number": self._number,
                **{topic: rows.get(topic, []) for topic in TOPICS}} if rows or is_first else None
