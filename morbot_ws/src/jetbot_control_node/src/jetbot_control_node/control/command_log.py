"""Which programs have recently sent commands. No ROS, no thread and no clock."""

import math
from typing import Collection, Dict, List, Set

from .state import Sender

RECENT = 1.5  # s between commands of two programs that contradict each other


class CommandLog:
    """Who sends commands, and how many there were. ``record`` and ``keep`` may be called from any thread."""

    def __init__(self):
        self.count = 0
        self._commanded_at: Dict[str, float] = {}
        self._manual: Set[str] = set()

    def record(self, sender: Sender, now: float) -> None:
        """A program has sent a command; a latched one counts as long as the program runs."""
        self.count += 1
        self._commanded_at[sender.name] = math.inf if sender.latched else now
        if sender.manual:
            self._manual.add(sender.name)

    def keep(self, senders: Collection[str]) -> None:
        """Forget all programs but these, which can still send commands."""
        for name in set(self._commanded_at) - set(senders):
            self._commanded_at.pop(name, None)

    def recent(self, now: float) -> List[str]:
        """Return the names of the programs that command the robot now."""
        return sorted(name for name, commanded_at in list(self._commanded_at.items()) if now - commanded_at < RECENT)

    def waiting(self, now: float) -> List[str]:
        """Return the names of those programs whose commands are ignored while only manual ones count."""
        return [name for name in self.recent(now) if name not in self._manual]
