"""How the robot is: what its battery and its computer measure, which a thread of its own reads. No ROS here."""

import time
from typing import Callable, Dict, List, Set, Tuple

from jetbot.health import OK, Health

from ..supply.supply_watch import SupplyWatch

INTERVAL = 5.0      # s from one reading of the computer to the next
STALE_AFTER = 20.0  # s; a reading that takes longer hangs, and the one before it is forgotten


class HealthWatch:
    """Readings of a robot's health: of its battery, and of its computer, if a thread runs ``run``.

    That may hang in Linux without delaying anything else.
    """

    def __init__(self, supply: SupplyWatch):
        self._supply = supply
        self._computer: Tuple[float, Dict[str, float]] = 0.0, {}
        self._reported: Set[Tuple[str, str]] = set()

    def run(self, read: Callable[[], Dict[str, float]], wait: Callable[[float], bool]) -> None:
        """Read the computer until it is over. wait: waits for so many seconds, and returns whether it is."""
        while True:
            readings = read()
            self._computer = time.monotonic(), readings
            if wait(INTERVAL):
                return

    def readings(self, now: float) -> Dict[str, float]:
        """Return what is known at a time, by names of health.READINGS."""
        read_at, computer = self._computer
        return {**self._supply.settled.battery, **(computer if now - read_at < STALE_AFTER else {})}

    def news(self, rows: List[Health]) -> List[Health]:
        """Return what a person at the terminal should read: what is not in order, each fact once at each level."""
        new = [row for row in rows if row.level != OK and (row.code, row.level) not in self._reported]
        self._reported.update((row.code, row.level) for row in new)
        return new
