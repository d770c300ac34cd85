"""The lease of a robot and its dead man's switch, which share one clock: that of the newest command.

A lease is one immutable value for all threads, in seconds of the computer's monotonic clock. The event loop ends leases
by it; the thread that publishes stops the robot by it, also while the loop stalls.
"""

from typing import NamedTuple

from .rights import Client

LEASE_TIMEOUT = 5.0    # s without a command after which a robot is free again
COMMAND_TIMEOUT = 0.3  # s without a command after which a robot that is driven stops


class Lease(NamedTuple):
    """A client's right to drive a robot, which has one driver. driving: whether its newest command moves the robot."""

    client: Client
    commanded_at: float
    driving: bool

    def has_expired(self, now: float) -> bool:
        """Return whether the driver has not commanded the robot for LEASE_TIMEOUT."""
        return now - self.commanded_at >= LEASE_TIMEOUT

    def is_silent(self, now: float) -> bool:
        """Return whether the dead man's switch has fired: the robot is driven, and no command comes any more."""
        return self.driving and now - self.commanded_at >= COMMAND_TIMEOUT

    def remaining(self, now: float) -> float:
        """Return the seconds until the switch of a robot that is driven fires."""
        return max(0.0, self.commanded_at + COMMAND_TIMEOUT - now)
