"""What a robot has reported in the last seconds, each value with its time, for the curves that pages draw of it."""

import math
import threading
from collections import deque
from typing import Deque, Dict, List, NamedTuple, Optional, Tuple

MAX_ROWS = 1000  # some 8 s of all topics of a simulated robot: a page that is late for longer has a gap


class Readings(NamedTuple):
    """What has come since a page was sent something. after, number: of the row before these, and of the newest one.

    rows: by topic, each its stamp (s since the epoch) and its values, as they were published.
    """

    after: int
    number: int
    rows: Dict[str, List[Tuple[float, ...]]]


class Recording:
    """The newest rows of a robot's topics. Any thread may call it."""

    def __init__(self):
        self._lock, self._number = threading.Lock(), 0
        self._rows: Deque[Tuple[int, str, Tuple[float, ...]]] = deque(maxlen=MAX_ROWS)

    def add(self, topic: str, *row: float) -> None:
        """Take a row: its stamp and its values. One that is not finite is left out."""
        if all(map(math.isfinite, row)):
            with self._lock:
                self._number += 1
                self._rows.append((self._number, topic, row))

    def since(self, number: Optional[int]) -> Readings:
        """Return the rows that came after the one with this number; None: none yet."""
        with self._lock:
            newest = self._number
            new = [] if number is None else [row for row in self._rows if row[0] > number]
        rows: Dict[str, List[Tuple[float, ...]]] = {}
        for _, topic, row in new:
            rows.setdefault(topic, []).append(row)
        return Readings(newest - len(new), newest, rows)
