"""The one thread that drives the robot: it owns the time, and stops the robot when it must not move. No ROS here."""

import contextlib
import queue
import threading
import time
from typing import Callable, Collection, Dict, Optional, Sequence, Tuple

from jetbot import BusError, JetbotError, Robot
from jetbot.wait import wait_until
from jetbot_ros.holds import Hold

from .notes import Commanders, Disturbances, FullPower, Observer, TooSlow
from .ramp import STEP_INTERVAL, Ramp
from .safety import STOPPED, Sender, State

DRIVING_INTERVAL = 0.05      # s between two checks of what may stop the robot while it drives
STOPPED_INTERVAL = 0.4       # s between two wake-ups while it is stopped; the guard's timeout is a second
RETRY_INTERVAL = 0.05        # s until a board that does not answer is tried again
VERIFY_AFTER_COMMAND = 0.1   # s between two verifications right after a command, when the next is not due soon
VERIFY_IDLE = 0.3            # s between two verifications at any other moment
FREEZE = 0.7                 # s between two steps after which this program was frozen, and with it its questions
#                              and heartbeats; the guard stops the wheels 0.75 s after a step at the earliest

GUARD_START_TIMEOUT = 5.0    # s until a guard that does not start is reported

NO_GUARD = JetbotError("the guard, which stops the wheels if this program dies, is not running")


class Supervisor:
    """Drives the velocity that its ``state`` allows. Any thread may call ``command``, ``hold``, ``confirm``, ``end``.

    drive: drives the robot at (linear, angular); senders: returns the names of the programs that could send commands;
    on_change: takes each State whose status differs from the one before. observers: called after every step,
    may return a note for the status. None of them may block. ramp: limits how fast the wheels speed up.
    closed: whether ``run`` has ended, with the wheels stopped.
    """

    def __init__(self, robot: Robot, drive: Callable[[float, float], None], cmd_vel_timeout: float,
                 senders: Callable[[], Collection[str]], on_change: Callable[[State], None],
                 observers: Sequence[Observer] = (), ramp: Optional[Ramp] = None):
        self._robot, self._drive = robot, drive
        self._observers = FullPower(robot), TooSlow(robot), *observers
        self._ramp = ramp or Ramp()
        robot.resumes = not self._ramp.acceleration_limit  # else what the board has lost comes back by the ramp
        self._senders, self._on_change = senders, on_change
        self.state = State(cmd_vel_timeout)
        self.closed = False
        self._lock = threading.Lock()  # held while ``state`` is replaced, never during a transfer
        self._events = queue.SimpleQueue()  # its put is reentrant, as a signal handler needs it
        self._ending, self._failure = False, None
        self._status = None
        self._fed_at = self._verified_at = float("-inf")
        self._stepped_at = float("inf")  # there is no step yet, and so no gap after it
        self._commanders, self._disturbances = Commanders(), Disturbances()
        self._faults = 0

    @property
    def disturbances(self) -> Dict[str, int]:
        """How often the board has lost its settings, been written to by another program, and failed to answer."""
        driver = self._robot.driver
        return {"resets": driver.resets, "overwritten": driver.overwritten, "faults": self._faults}

    def command(self, linear: float, angular: float, sender: Sender) -> None:
        """Accept a command: m/s forward and rad/s to the left."""
        now = time.monotonic()
        if not sender.old:
            self._commanders.record(sender, now)
        self._change(State.command, linear, angular, sender, now)
        self._wake()

    def hold(self, hold: Hold, engaged: bool) -> None:
        """Keep the robot stopped, whatever is commanded (True), or end that (False)."""
        self._change(State.hold, hold, engaged)
        self._wake()

    def confirm(self, name: str, asked_at: float) -> None:
        """Accept that the program of this name has answered a question that was asked at ``asked_at``."""
        self._change(State.confirm, name, asked_at)

    def fail(self, failure: JetbotError) -> None:
        """Make ``run`` end soon, and raise this."""
        self._failure = failure
        self.end()

    def end(self, *_) -> None:
        """Make ``run`` end soon; may be a signal handler."""
        self._ending = True
        self._wake()

    def run(self, is_over: Callable[[], bool]) -> None:
        """Drive until ``end`` or ``is_over``, then close the robot. Raise JetbotError for what cannot be retried."""
        try:
            wait_until(lambda: self._robot.guarded or self._ending or is_over(), GUARD_START_TIMEOUT)
            commanded = False
            while not (self._ending or is_over()):
                commanded = self._sleep(self.step(time.monotonic(), commanded))
            if self._failure:
                raise self._failure
        finally:
            with contextlib.suppress(JetbotError):  # the guard reports it, and keeps trying
                self._robot.close()
                self.closed = True
            self._observe(time.monotonic())

    def step(self, now: float, commanded: bool) -> float:
        """Do all that is due at the time ``now``; return the seconds until the next step, if nothing happens before.

        commanded: whether something has just happened, such as a command.
        """
        senders = self._senders()
        if now - self._stepped_at > FREEZE:
            self._change(State.confirm, self.state.held_for, now)
            self._robot.driver.invalidate()  # the guard may have stopped the wheels meanwhile
        self._stepped_at = now
        self._change(State.check_timeout, senders, now)
        state, fault = self.state, None
        try:
            fault = self._drive_if_guarded(state, now)
            self._verify(now, commanded)
        except BusError as error:
            fault = error
        interval = self._robot.driver.keep_alive_interval if state.driving else STOPPED_INTERVAL
        self._keep_alive(now, interval)
        if self._ramp.acceleration_limit and not any(self._robot.duties):
            self._ramp.reset()  # whatever has stopped the wheels
        self._faults += isinstance(fault, BusError) and not state.fault
        self._change(State.driven, fault, *self._notes(senders, now, state.is_manual(now)))
        self._report()
        return min(self._pause(), self._fed_at + interval - now)

    def _pause(self):
        if self.state.fault:
            return RETRY_INTERVAL
        if self._ramp.active:
            return STEP_INTERVAL
        return DRIVING_INTERVAL if self.state.driving else STOPPED_INTERVAL

    def _drive_if_guarded(self, state, now):
        """Drive, or stop if there is no guard; return the fault."""
        if state.driving and not self._robot.guarded:
            self._drive(*STOPPED)
            self._fed_at = float("-inf")  # now: a heartbeat starts another guard
            return NO_GUARD
        self._drive(*self._ramp.limit(state.velocity, now))
        return None

    def _notes(self, senders, now, manual) -> Tuple[Tuple[str, ...], Optional[str]]:
        """Return the notes and the remark of the status. manual: whether only manual commands count."""
        rivals, ignored = ((None, self._commanders.ignored(senders, now)) if manual else
                           (self._commanders.note(senders, now), None))
        notes = [rivals, *self._observe(now), *self._disturbances.notes(self.disturbances, now)]
        return tuple(note for note in notes if note), ignored

    def _observe(self, now):
        duties = self._robot.duties
        return [observe(duties, now) for observe in self._observers]

    def _wake(self):
        if self._events.empty():  # one that the thread has not taken yet will do
            self._events.put(None)

    def _sleep(self, seconds):
        """Sleep until something happens, at most for ``seconds``; return whether it did."""
        with contextlib.suppress(queue.Empty):
            self._events.get(timeout=max(0.0, seconds))
            return True
        return False

    def _change(self, event, *arguments):
        with self._lock:
            self.state = event(self.state, *arguments)

    def _verify(self, now, commanded):
        """Verify a part of the board: after a command, or if none came for a while, so that no command waits for it."""
        if now - self._verified_at >= (VERIFY_AFTER_COMMAND if commanded else VERIFY_IDLE):
            self._verified_at = now
            self._robot.verify()

    def _keep_alive(self, now, interval):
        if now - self._fed_at >= interval:
            self._fed_at = now
            with contextlib.suppress(BusError):  # the next drive reports it
                self._robot.keep_alive()

    def _report(self):
        state = self.state
        if state.status != self._status:
            self._status = state.status
            self._on_change(state)
