"""Who may drive and stop which robot, and when driving is over. Times are monotonic seconds."""

from typing import Callable, Dict, Iterable, List, NamedTuple, Optional, Set

from ..notices import Notice, say
from .messages import FROM_PAGE
from .snapshot import label

PUPIL, TEACHER = "pupil", "teacher"
LEASE_TIMEOUT = 5.0    # s without a command after which a robot is free again
COMMAND_TIMEOUT = 0.3  # s without a command after which a robot that is driven stops
MINUTE = 60.0          # s, in which stalls are counted
TAKEN, STOPPED = "robot", "programs"  # what a teacher keeps waiting: pupils and programs, or programs alone


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


def refuse_role(client: Client, kind: str) -> Optional[Notice]:
    """Return why somebody of this role may not send such a message, or None."""
    return say(f"teacher_{kind}") if FROM_PAGE[kind].teacher and client.role != TEACHER else None


class Lease(NamedTuple):
    """A client's right to drive a robot, which has one driver. driving: whether its newest command moves the robot."""

    client: int
    commanded_at: float
    driving: bool

    def has_expired(self, now: float) -> bool:
        """Return whether the driver has not commanded the robot for LEASE_TIMEOUT."""
        return now - self.commanded_at >= LEASE_TIMEOUT

    def is_silent(self, now: float) -> bool:
        """Return whether the robot is driven, and no command has come for COMMAND_TIMEOUT."""
        return self.driving and now - self.commanded_at >= COMMAND_TIMEOUT


class DeadMan:
    """A robot's switch: it fires when commands stop arriving while the robot is driven; then the pad must be let go."""

    def __init__(self):
        self._fed_at: Optional[float] = None  # None: not driven
        self._fired = False
        self._fired_at: List[float] = []  # within the last minute

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
        if not self._fired and self._fed_at is not None and now - self._fed_at >= COMMAND_TIMEOUT:
            self._fired = True
            self._fired_at.append(now)
        return self._fired

    def stalls(self, now: float) -> int:
        """Return how often the switch has fired within the last minute."""
        self._fired_at = [time for time in self._fired_at if now - time < MINUTE]
        return len(self._fired_at)

    def remaining(self, now: float) -> Optional[float]:
        """Return the seconds until the switch fires, or None if the robot is not driven."""
        return None if self._fed_at is None else max(0.0, self._fed_at + COMMAND_TIMEOUT - now)


class StopRights:
    """Who may engage and release an emergency stop: that of all robots (None), or a robot's own.

    A pupil releases only what pupils alone have engaged here: no stop by a teacher, and none from a terminal.
    """

    def __init__(self):
        self._by_pupils: Set[Optional[str]] = set()

    def engage(self, client: Client, robot: Optional[str], engaged: bool) -> Optional[Notice]:
        """Return why the client may not engage this stop, or None. engaged: whether it may be already."""
        if not client.may_stop(robot):
            return say("teacher_stops_one")
        if client.role == TEACHER:
            self._by_pupils.discard(robot)
        elif not engaged:
            self._by_pupils.add(robot)
        return None

    def release(self, client: Client, robot: Optional[str]) -> Optional[Notice]:
        """Return why the client may not release this stop, or None."""
        if not client.may_stop(robot):
            return say("teacher_releases_one")
        if client.role != TEACHER and robot not in self._by_pupils:
            return say("teacher_releases")
        return None

    @property
    def pupils_release(self) -> bool:
        """Whether a pupil may release the stop of all robots."""
        return None in self._by_pupils

    def update(self, is_engaged_here: Callable[[Optional[str]], bool]) -> None:
        """Forget the stops that are over, and those that another program has engaged as well."""
        self._by_pupils = set(filter(is_engaged_here, self._by_pupils))


class Holds:
    """Robots that teachers have taken or stopped: they wait until a teacher gives them back, whoever comes and goes.

    keep_waiting: is called with a robot, and whether its programs wait.
    """

    def __init__(self, keep_waiting: Callable[[str, bool], None]):
        self._keep_waiting = keep_waiting
        self._held: Dict[str, str] = {}  # TAKEN or STOPPED, by robot
        self._all = False  # whether robots that come are held, too: a teacher's stop of all is engaged

    def __getitem__(self, robot: str) -> Optional[str]:
        """Return TAKEN, STOPPED, or None for a robot that no teacher holds."""
        return self._held.get(robot)

    def take(self, robot: str) -> None:
        """A teacher takes the robot."""
        self._held[robot] = TAKEN
        self._keep_waiting(robot, True)

    def stop(self, robots: Iterable[str], all_robots: bool) -> None:
        """A teacher stops these robots. all_robots: and those that come until the release."""
        self._all = self._all or all_robots
        for robot in robots:
            self._held.setdefault(robot, STOPPED)
            self._keep_waiting(robot, True)

    def update(self, emergency: bool, comers: Iterable[str]) -> None:
        """Hold the robots that have come as well, while a teacher's stop of all is engaged."""
        self._all = self._all and emergency
        if self._all:
            self.stop(comers, True)

    def give_back(self, robot: Optional[str]) -> None:
        """Let this robot, or all (None), go on."""
        for each in list(self._held) if robot is None else [robot]:
            if self._held.pop(each, None):
                self._keep_waiting(each, False)

    def refusal(self, client: Client, robot: str) -> Optional[Notice]:
        """Return why the client may not drive this robot, or None."""
        if client.role == TEACHER or self._held.get(robot) != TAKEN:
            return None
        return say("taken", robot=label(robot))
