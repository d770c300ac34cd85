"""What decides whether the robot may move. No ROS, no thread and no clock: times are monotonic seconds, handed in."""

import math
from typing import Dict, List, NamedTuple, Optional, Set, Tuple

from jetbot_ros.state import HOLDS, MANUAL_PRIORITY, Cause, because

STOPPED = (0.0, 0.0)
ANSWER_TIMEOUT = 1.0  # s that a program whose command is held may leave unanswered whether it still runs
MAX_ENDED = 100       # numbers of ended connections that are kept
RECENT = 1.5  # s between commands of two programs that contradict each other


class Sender(NamedTuple):
    """The program that sent a command.

    latched: its command is a standing order, in force until the program ends, freezes or is cut off.
    old: ROS delivered a command again that is older than this node or than an interruption; it moves nothing.
    manual: a person drives by this program; its commands have priority over those of others.
    number: of its connection; the same name with another number is another program.
    """

    name: str
    latched: bool = False
    old: bool = False
    manual: bool = False
    number: int = 0


class State(NamedTuple):
    """The ``speeds`` that the wheels may have now, or the cause why none. Immutable: each event returns the next state.

    timeout: seconds without a command after which the robot stops; 0 holds the last command.
    speeds: (left, right), as Robot.set_motors takes them; alarm: whether something other than a command stopped the
    robot; sender: of the newest command, which arrived at ``commanded_at``; confirmed_at: when it was last known to
    run, if its command is held; manual_at: when the newest manual command arrived, of zero too; ended: the numbers of
    the connections that have ended last: a command of theirs may still be on its way.

    A hold takes precedence until it is released; then the newest command counts, until it is too old or its sender is
    gone. For MANUAL_PRIORITY seconds after a manual command, only manual ones count. Whatever stopped the robot, only a
    new command moves it again.
    """

    timeout: float
    speeds: Tuple[float, float] = STOPPED
    cause: Optional[Cause] = because("no_command_yet")
    alarm: bool = False
    holds: Tuple[str, ...] = ()
    commanded_at: Optional[float] = None
    sender: Optional[Sender] = None
    confirmed_at: Optional[float] = None
    manual_at: float = -math.inf
    ended: Tuple[int, ...] = ()

    @property
    def driving(self) -> bool:
        """Whether the robot may move now."""
        return self.speeds != STOPPED

    @property
    def must_answer(self) -> Optional[Sender]:
        """The sender that must be asked whether it runs, as its command is driven without being repeated; or None."""
        return self.sender if self.driving and (self.sender.latched or not self.timeout) else None

    @property
    def deadline(self) -> float:
        """When ``check_timeout`` stops the robot, if nothing happens before."""
        if not self.driving:
            return math.inf
        return self.confirmed_at + ANSWER_TIMEOUT if self.must_answer else self.commanded_at + self.timeout

    def is_manual(self, now: float) -> bool:
        """Return whether only manual commands count at the time ``now``."""
        return now - self.manual_at < MANUAL_PRIORITY

    def command(self, left: float, right: float, sender: Sender, now: float) -> "State":
        """A command has arrived; one that is not finite stops the robot."""
        if sender.number in self.ended:
            return self
        if sender.old:
            return self._refuse(sender)
        if not sender.manual and self.is_manual(now):
            return self
        speeds, cause, alarm = self._obey(left, right)
        return self._replace(speeds=speeds, cause=cause, alarm=alarm, commanded_at=now, sender=sender,
                             confirmed_at=now, manual_at=now if sender.manual else self.manual_at)

    def _obey(self, left, right):
        """Return speeds, cause and alarm of a command."""
        if self.holds:
            return self.speeds, self.cause, self.alarm
        if not (math.isfinite(left) and math.isfinite(right)):
            return STOPPED, because("not_finite"), True
        speeds = round(left, 9), round(right, 9)  # 0.1 + 0.2 - 0.3 is zero
        if speeds == STOPPED:
            return STOPPED, because("zero"), False
        return speeds, None, False

    def _refuse(self, sender):
        if self.driving or self.holds:
            return self
        return self._stop(because("old_command", program=sender.name))

    def hold(self, hold: str, engaged: bool) -> "State":
        """Something that keeps the robot stopped has begun (True) or ended (False)."""
        if engaged == (hold in self.holds):
            return self
        holds = tuple(each for each in HOLDS if (engaged if each == hold else each in self.holds))
        return self._stop(because(holds[0] if holds else f"{hold}_released"))._replace(holds=holds)

    def confirm(self, sender: Optional[Sender], asked_at: float) -> "State":
        """This program has answered a question that was asked at ``asked_at``."""
        if not sender or not self.must_answer or sender.number != self.must_answer.number:
            return self
        return self._replace(confirmed_at=max(asked_at, self.confirmed_at))

    def disconnect(self, sender: Sender, others: bool) -> "State":
        """This program can no longer send commands. others: whether another one can."""
        state = self._replace(ended=(*self.ended[1 - MAX_ENDED:], sender.number))
        if not self.driving or self.sender.number != sender.number:
            return state
        return state._stop(because("program_ended", program=sender.name) if others else because("nobody"))

    def check_timeout(self, now: float) -> "State":
        """Some time has passed."""
        if now < self.deadline:
            return self
        return self._stop(because("program_silent", program=self.sender.name) if self.must_answer else
                          because("no_command", seconds=f"{self.timeout:.1f}"))

    def _stop(self, cause: Cause) -> "State":
        return self._replace(speeds=STOPPED, cause=cause, alarm=True)


class CommandLog:
    """Who sends commands, and how many there were. ``record`` and ``forget`` may be called from any thread."""

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

    def forget(self, name: str) -> None:
        """The program of this name can no longer send commands."""
        self._commanded_at.pop(name, None)

    def recent(self, now: float) -> List[str]:
        """Return the names of the programs that command the robot now."""
        return sorted(name for name, commanded_at in list(self._commanded_at.items()) if now - commanded_at < RECENT)

    def waiting(self, now: float) -> List[str]:
        """Return the names of those programs whose commands are ignored while only manual ones count."""
        return [name for name in self.recent(now) if name not in self._manual]
