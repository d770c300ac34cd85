"""Who may drive and stop which robot: roles, leases, and emergency stops that only a teacher releases."""

from typing import Callable, Dict, List, NamedTuple, Optional, Set

PUPIL, TEACHER = "pupil", "teacher"
LEASE_TIMEOUT = 5.0  # s without a command after which a robot is free again


class Client(NamedTuple):
    """Somebody at a page. role: PUPIL or TEACHER; robot: the only one that a pupil may drive, None: any."""

    id: int
    name: str
    role: str
    robot: Optional[str] = None

    def may_drive(self, robot: str) -> bool:
        """Return whether this person may drive the robot."""
        return self.role == TEACHER or self.robot in (None, robot)

    def may_stop(self, robot: Optional[str]) -> bool:
        """Return whether this person may stop the robot, or all (None): anybody stops all."""
        return self.role == TEACHER or robot in (None, self.robot)


class Lease(NamedTuple):
    """A client's right to drive a robot. driving: whether its newest command moves the robot."""

    client: int
    commanded_at: float
    driving: bool


class Leases:
    """Who drives which robot: one driver per robot. Times are monotonic seconds."""

    def __init__(self):
        self._leases: Dict[str, Lease] = {}

    def robots(self) -> List[str]:
        """Return the robots that have a driver."""
        return list(self._leases)

    def driver(self, robot: str) -> Optional[int]:
        """Return the client that may drive the robot, or None if it is free."""
        lease = self._leases.get(robot)
        return lease.client if lease else None

    def robot_of(self, client: int) -> Optional[str]:
        """Return the robot that the client may drive, or None."""
        return next((robot for robot, lease in self._leases.items() if lease.client == client), None)

    def renew(self, robot: str, client: int, now: float, driving: bool) -> None:
        """Give the robot, which is free or the client's own, to the client."""
        self._leases[robot] = Lease(client, now, driving)

    def end(self, robot: str) -> Optional[Lease]:
        """Make the robot free; return the lease that has ended, or None."""
        return self._leases.pop(robot, None)

    def has_expired(self, robot: str, now: float) -> bool:
        """Return whether the robot's driver has not commanded it for LEASE_TIMEOUT."""
        return now - self._leases[robot].commanded_at >= LEASE_TIMEOUT


class StopRights:
    """Who may engage and release an emergency stop: that of all robots (None), or a robot's own.

    One that a teacher has engaged is released by a teacher; any other by anybody who may engage it.
    """

    def __init__(self):
        self._by_teacher: Set[Optional[str]] = set()

    def engage(self, client: Client, robot: Optional[str]) -> str:
        """Return why the client may not engage this stop, or ""."""
        if not client.may_stop(robot):
            return "Only a teacher can stop a single robot. You can stop all."
        if client.role == TEACHER:
            self._by_teacher.add(robot)
        return ""

    def release(self, client: Client, robot: Optional[str]) -> str:
        """Return why the client may not release this stop, or ""."""
        if not client.may_stop(robot):
            return "Only a teacher can release a single robot."
        if client.role != TEACHER and robot in self._by_teacher:
            return "A teacher stopped this. Only a teacher can release it."
        self._by_teacher.discard(robot)
        return ""

    def update(self, is_stopped: Callable[[Optional[str]], bool]) -> None:
        """Forget the stops that somebody else has released, with ROS."""
        self._by_teacher = set(filter(is_stopped, self._by_teacher))
