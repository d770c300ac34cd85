"""The dead man's switch of one robot. Times are monotonic seconds."""

from typing import Optional

TIMEOUT = 0.3  # s without a command after which a robot that is driven stops


class DeadMan:
    """Fires when commands stop arriving while the robot is driven; then the pad must be let go first."""

    def __init__(self):
        self._fed_at: Optional[float] = None
        self._fired = False

    def feed(self, now: float) -> bool:
        """A command has arrived. Return whether it may be driven: not after the switch has fired."""
        if self.check(now):
            return False
        self._fed_at = now
        return True

    def let_go(self) -> None:
        """The pad was let go: the robot is not driven, and may be driven again."""
        self._fed_at, self._fired = None, False

    def check(self, now: float) -> bool:
        """Return whether the switch has fired."""
        self._fired = self._fired or self._fed_at is not None and now - self._fed_at >= TIMEOUT
        return self._fired

    def remaining(self, now: float) -> Optional[float]:
        """Return the seconds until the switch fires, or None if the robot is not driven."""
        return None if self._fed_at is None else max(0.0, self._fed_at + TIMEOUT - now)
