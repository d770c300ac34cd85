"""One driver per robot, and one robot per driver. No clock: times are monotonic seconds, handed in."""

from typing import Dict, List, NamedTuple, Optional

TIMEOUT = 5.0  # s without a command after which a robot is free again


class Lease(NamedTuple):
    """A client's right to drive a robot. driving: whether its newest command moves the robot."""

    client: int
    commanded_at: float
    driving: bool = False


class Leases:
    """Who drives which robot."""

    def __init__(self):
        self._leases: Dict[str, Lease] = {}

    def robots(self) -> List[str]:
        """Return the robots that somebody has a lease of."""
        return list(self._leases)

    def driver(self, robot: str) -> Optional[int]:
        """Return the client that may drive the robot, or None if it is free."""
        lease = self._leases.get(robot)
        return lease.client if lease else None

    def robot_of(self, client: int) -> Optional[str]:
        """Return the robot that the client may drive, or None."""
        return next((robot for robot, lease in self._leases.items() if lease.client == client), None)

    def renew(self, robot: str, client: int, now: float, driving: bool) -> None:
        """Give the robot, which is free or the client's own, to the client; its other robot becomes free."""
        if self.driver(robot) not in (None, client):
            raise ValueError(f"another client drives {robot}")
        other = self.robot_of(client)
        if other not in (None, robot):
            self.end(other)
        self._leases[robot] = Lease(client, now, driving)

    def end(self, robot: str) -> Optional[Lease]:
        """Make the robot free; return the lease that has ended, or None."""
        return self._leases.pop(robot, None)

    def has_expired(self, robot: str, now: float) -> bool:
        """Return whether the robot's driver has not commanded it for TIMEOUT."""
        return now - self._leases[robot].commanded_at >= TIMEOUT
