"""What decides whether the robot may move. No ROS, no thread and no clock: times are monotonic seconds, handed in."""

import math
from typing import NamedTuple, Optional, Tuple

from jetbot import BusError

STOPPED = (0.0, 0.0)


class State(NamedTuple):
    """The ``velocity`` that may be driven now, and why. Immutable: each event returns the state that follows it.

    timeout: seconds without a command after which the robot stops; 0 holds the last command.
    velocity: (linear in m/s, angular in rad/s), always finite; commands: how many arrived;
    fault: while the board does not answer; alarm: whether something other than a command stopped the robot.

    An emergency stop takes precedence until it is released; then the newest command counts, until it is too old or
    nobody is left to send another. Whatever stopped the robot, only a new command moves it again.
    """

    timeout: float
    velocity: Tuple[float, float] = STOPPED
    reason: str = "stopped: no command yet"
    alarm: bool = False
    emergency: bool = False
    commanded_at: Optional[float] = None
    commands: int = 0
    fault: Optional[BusError] = None

    @property
    def driving(self) -> bool:
        """Whether the robot may move now."""
        return self.velocity != STOPPED

    @property
    def status(self) -> str:
        """What the robot does and why, in one sentence."""
        return f"stopped: {self.fault.reason}, trying again" if self.fault else self.reason

    def command(self, linear: float, angular: float, now: float) -> "State":
        """A command has arrived; one that is not finite stops the robot."""
        state = self._replace(commanded_at=now, commands=self.commands + 1)
        if self.emergency:
            return state
        if not (math.isfinite(linear) and math.isfinite(angular)):
            return state._stop("command was not finite")
        if (linear, angular) == STOPPED:
            return state._stop("the command is zero", alarm=False)
        return state._replace(velocity=(linear, angular), reason="driving", alarm=False)

    def emergency_stop(self, engaged: bool) -> "State":
        """The emergency stop was pressed (True) or released (False)."""
        if engaged:
            return self._stop("emergency stop")._replace(emergency=True)
        if self.emergency:
            return self._stop("no command since the emergency stop was released")._replace(emergency=False)
        return self

    def check_timeout(self, publishers: int, now: float) -> "State":
        """Some time has passed; ``publishers`` of commands are left."""
        if self.driving and publishers == 0:
            return self._stop("nobody is left to send commands")
        if self.driving and self.timeout and now - self.commanded_at >= self.timeout:
            return self._stop(f"no command for {self.timeout:.1f} s")
        return self

    def board_answered(self, fault: Optional[BusError]) -> "State":
        """The board was driven; fault: None if it answered."""
        return self if fault is self.fault else self._replace(fault=fault)

    def _stop(self, cause: str, alarm: bool = True) -> "State":
        return self._replace(velocity=STOPPED, reason=f"stopped: {cause}", alarm=alarm)
