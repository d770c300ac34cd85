"""What a page is shown of a robot's camera: always the newest picture. Times are monotonic seconds."""

import math
from typing import List, NamedTuple, Optional, Union

PART = 32768          # bytes sent at once: an idle socket takes them whole, so that states and answers need not wait
MAX_FPS = 15.0        # pictures per second for one page,
MAX_TOTAL_FPS = 75.0  # and for all: 5 each for a class of 15
ANSWER_TIMEOUT = 5.0  # s without an acknowledgement after which nobody looks any more


class Picture(NamedTuple):
    """A JPEG. stamp: when it was exposed, in s since the epoch by the robot's clock; came_at: when it came here."""

    jpeg: bytes
    stamp: float
    came_at: float


def interval(pages: int) -> float:
    """Return the seconds between two pictures for each of so many pages."""
    return max(1 / MAX_FPS, pages / MAX_TOTAL_FPS)


class Feed:
    """The pictures for one page. It is sent the next part once it has acknowledged the one before.

    robot: whose camera the page shows, None: none.
    """

    def __init__(self):
        self.robot: Optional[str] = None
        self._newest: Optional[Picture] = None  # of which something was sent
        self._rest, self._number = b"", 0
        self._waits, self._sent_at, self._due_at = False, -math.inf, -math.inf

    def look(self, robot: Optional[str]) -> None:
        """The page shows this robot's camera from now on."""
        self.robot, self._newest, self._rest, self._waits = robot, None, b"", False

    def acknowledge(self, number: float) -> None:
        """The page has got a part of the picture with this number."""
        self._waits = self._waits and number != self._number

    def is_used(self, now: float) -> bool:
        """Return whether somebody looks."""
        return self.robot is not None and not (self._waits and now - self._sent_at >= ANSWER_TIMEOUT)

    def next(self, newest: Optional[Picture], pause: float, now: float) -> List[Union[dict, bytes]]:
        """Return what is sent now: a part of a picture, before its first one the message "picture", or nothing.

        newest: the robot's; pause: s between two pictures.
        """
        is_due = newest not in (None, self._newest) and now >= self._due_at
        if self._waits or not self._rest and not is_due:
            return []
        messages = []
        if not self._rest:
            self._newest, self._rest, self._number = newest, newest.jpeg, self._number + 1
            self._due_at = max(self._due_at, now - pause) + pause  # one may come early: a camera as fast never waits
            messages = [{"type": "picture", "robot": self.robot, "number": self._number, "stamp": newest.stamp,
                         "bytes": len(newest.jpeg)}]
        part, self._rest = self._rest[:PART], self._rest[PART:]
        self._waits, self._sent_at = True, now
        return [*messages, part]
