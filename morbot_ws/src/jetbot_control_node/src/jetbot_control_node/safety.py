"""What decides whether the robot may move. No ROS, no thread and no clock: times are monotonic seconds, handed in."""

import math
from typing import Collection, NamedTuple, Optional, Tuple

from jetbot import JetbotError
from jetbot_ros.holds import HOLDS, Hold

STOPPED = (0.0, 0.0)
ANSWER_TIMEOUT = 1.0  # s that a program whose command is held may leave unanswered whether it still runs
MANUAL_PRIORITY = 5.0  # s after a manual command in which those of other programs are ignored


class Sender(NamedTuple):
    """The program that sent a command.

    latched: its command is a standing order, in force until the program ends, freezes or is cut off.
    old: ROS delivered a command again that is older than this node or than an interruption; it moves nothing.
    manual: a person drives by this program; its commands have priority over those of others.
    """

    name: str
    latched: bool = False
    old: bool = False
    manual: bool = False


class State(NamedTuple):
    """The ``velocity`` that may be driven now, and why. Immutable: each event returns the state that follows it.

    timeout: seconds without a command after which the robot stops; 0 holds the last command.
    velocity: (linear in m/s, angular in rad/s), always finite; commands: how many arrived;
    sender: of the newest command; confirmed_at: when it was last known to run, if its command is held;
    manual_at: when the newest manual command arrived, of zero too;
    fault: while the robot cannot be driven; alarm: whether something other than a command stopped the robot;
    notes: what else the status reports, with a warning; remark: the same, without one.

    A hold takes precedence until it is released; then the newest command counts, until it is too old or its sender is
    gone. For MANUAL_PRIORITY seconds after a manual command, only manual ones count. Whatever stopped the robot, only a
    new command moves it again.
    """

    timeout: float
    velocity: Tuple[float, float] = STOPPED
    reason: str = "stopped: no command yet"
    alarm: bool = False
    holds: Tuple[Hold, ...] = ()
    commanded_at: Optional[float] = None
    commands: int = 0
    sender: Optional[Sender] = None
    confirmed_at: Optional[float] = None
    fault: Optional[JetbotError] = None
    notes: Tuple[str, ...] = ()
    remark: Optional[str] = None
    manual_at: float = -math.inf

    @property
    def driving(self) -> bool:
        """Whether the robot may move now."""
        return self.velocity != STOPPED

    @property
    def status(self) -> str:
        """What the robot does and why, in one sentence."""
        if self.fault:
            return f"stopped: {self.fault.reason}, trying again"
        remarks = [self.remark] if self.remark and not self.holds else []
        return ", ".join([self.reason, *(() if self.alarm else self.notes), *remarks])

    @property
    def warning(self) -> bool:
        """Whether the status is something that a person should look at."""
        return bool(self.fault or self.alarm or self.notes)

    @property
    def held_for(self) -> Optional[str]:
        """The name of the sender whose command is driven without being repeated, or None."""
        return self.sender.name if self.driving and (self.sender.latched or not self.timeout) else None

    def is_manual(self, now: float) -> bool:
        """Return whether only manual commands count at the time ``now``."""
        return now - self.manual_at < MANUAL_PRIORITY

    def command(self, linear: float, angular: float, sender: Sender, now: float) -> "State":
        """A command has arrived; one that is not finite stops the robot."""
        if sender.old:
            return self._refuse(sender)
        if not sender.manual and self.is_manual(now):
            return self._replace(commands=self.commands + 1)
        state = self._replace(commanded_at=now, commands=self.commands + 1, sender=sender, confirmed_at=now,
                              manual_at=now if sender.manual else self.manual_at)
        if self.holds:
            return state
        if not (math.isfinite(linear) and math.isfinite(angular)):
            return state._stop("command was not finite")
        velocity = round(linear, 9), round(angular, 9)  # 0.1 + 0.2 - 0.3 is zero
        if velocity == STOPPED:
            return state._stop("the command is zero", alarm=False)
        return state._replace(velocity=velocity, reason="driving", alarm=False)

    def hold(self, hold: Hold, engaged: bool) -> "State":
        """Something that keeps the robot stopped has begun (True) or ended (False)."""
        if engaged == (hold in self.holds):
            return self
        holds = tuple(each for each in HOLDS if (engaged if each is hold else each in self.holds))
        cause = holds[0].reason if holds else f"no command since {hold.released}"
        return self._stop(cause)._replace(holds=holds)

    def confirm(self, name: Optional[str], asked_at: float) -> "State":
        """The program of this name has answered a question that was asked at ``asked_at``."""
        if name is None or name != self.held_for:
            return self
        return self._replace(confirmed_at=max(asked_at, self.confirmed_at))

    def check_timeout(self, senders: Collection[str], now: float) -> "State":
        """Some time has passed; ``senders`` are the names of the programs that could send commands."""
        if not self.driving:
            return self
        if self.sender.name not in senders:
            return self._stop(f"{self.sender.name} has ended" if senders else "nobody is left to send commands")
        if self.held_for and now - self.confirmed_at >= ANSWER_TIMEOUT:
            return self._stop(f"{self.sender.name} does not answer")
        if not self.held_for and now - self.commanded_at >= self.timeout:
            return self._stop(f"no command for {self.timeout:.1f} s (repeat it: rostopic pub -r 10)")
        return self

    def driven(self, fault: Optional[JetbotError], notes: Tuple[str, ...], remark: Optional[str] = None) -> "State":
        """The robot was driven; fault: None if that worked."""
        if (fault, notes, remark) == (self.fault, self.notes, self.remark):
            return self
        return self._replace(fault=fault, notes=notes, remark=remark)

    def _refuse(self, sender):
        if self.driving or self.holds:
            return self
        return self._stop(f"the command of {sender.name} is from before, repeat it")

    def _stop(self, cause: str, alarm: bool = True) -> "State":
        return self._replace(velocity=STOPPED, reason=f"stopped: {cause}", alarm=alarm)
