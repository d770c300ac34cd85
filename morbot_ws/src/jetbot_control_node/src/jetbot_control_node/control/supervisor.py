"""Drives the robot, one step at a time: it owns the time, and stops the robot when it must not move. No ROS here."""

import contextlib
import math
import queue
import threading
import time
from typing import Callable, List, NamedTuple, Optional, Tuple

from jetbot import BusError, JetbotError
from jetbot.robot import Robot
from jetbot.wait import wait_until

from .ramp import STEP_INTERVAL, Ramp
from .state_machine import STOPPED, CommandLog, Sender, State

STOPPED_INTERVAL = 0.4       # s between two heartbeats while it is stopped; the guard's timeout is a second
RETRY_INTERVAL = 0.05        # s until a board that does not answer is tried again
UPKEEP_AFTER_COMMAND = 0.15  # s between two verifications and heartbeats right after a command, as no other is due soon
FREEZE = 0.7                 # s between two steps after which this program was frozen, and with it its questions
#                              and heartbeats; the guard stops the wheels 0.75 s after a step at the earliest
STALE_FOR = 0.3              # s after a freeze in which commands have waited for its end, and are old
GUARD_START_TIMEOUT = 5.0    # s until a guard that does not start is reported

NO_GUARD = JetbotError("the guard, which stops the wheels if this program dies, is not running")


class Step(NamedTuple):
    """What the supervisor has done at the time ``at``, for those who watch it.

    state: what was to be driven, and why; fault: why that failed, or None. speeds: (left, right) that were driven;
    duties: what the wheels are given, as ``Robot.duties``.
    """

    at: float
    state: State
    fault: Optional[JetbotError]
    speeds: Tuple[float, float]
    duties: Tuple[float, float]


class Supervisor:
    """Drives the wheels as its ``state`` allows. Any thread may call what happens: ``command`` to ``end``.

    A command is driven by the thread that brings it, which saves a change of threads; all else by the one in ``run``.

    ramp: limits how fast the wheels speed up, if anything does. ``watchers`` are called with each Step that differs
    from the one before, and with each heartbeat; none may block or drive.
    asking: set while the sender of the command that is driven must be asked whether it runs.
    faults: how often the board failed to answer; closed: whether ``run`` has ended, with the wheels stopped.
    """

    def __init__(self, robot: Robot, cmd_vel_timeout: float, ramp: Optional[Ramp] = None):
        self.robot, self._ramp = robot, ramp
        robot.resumes = ramp is None  # else what the board has lost comes back by the ramp
        self.state, self.commands = State(cmd_vel_timeout), CommandLog()
        self.watchers: List[Callable[[Step], None]] = []
        self.asking = threading.Event()
        self.faults, self.closed = 0, False
        self._lock = threading.Lock()  # held while ``state`` is replaced, never during a transfer
        self._stepping = threading.Lock()  # held during a step
        self._running = False  # whether ``run`` drives; before it does, nothing would stop what a command drives
        self._events = queue.SimpleQueue()  # its put is reentrant, as a signal handler needs it
        self._ending, self._failure = False, None
        self._step = Step(-math.inf, self.state, None, STOPPED, STOPPED)
        self._kept_up_at = -math.inf
        self._stepped_at = self._due_at = math.inf  # there is no step yet, and so no gap after it
        self._stale_until = -math.inf
        self._wakes_at = math.inf  # when the thread in ``run`` looks whether a step is due

    def command(self, left: float, right: float, sender: Sender) -> None:
        """Accept a command: the speeds of the wheels, as Robot.set_motors takes them."""
        now = time.monotonic()
        self._notice_freeze(now)
        if now < self._stale_until:
            sender = sender._replace(old=True)
        with self._lock:
            if not sender.old and sender.number not in self.state.ended:
                self.commands.record(sender, now)
            self.state = self.state.command(left, right, sender, now)
        self._step_at_once()

    def hold(self, hold: str, engaged: bool) -> None:
        """Keep the robot stopped, whatever is commanded (True), or end that (False). hold: one of HOLDS."""
        with self._lock:
            self.state = self.state.hold(hold, engaged)
        self._wake()

    def confirm(self, sender: Optional[Sender], asked_at: float) -> None:
        """Accept that this program has answered a question that was asked at ``asked_at``."""
        with self._lock:
            self.state = self.state.confirm(sender, asked_at)

    def disconnect(self, sender: Sender, others: bool) -> None:
        """Accept that this program can no longer send commands. others: whether another one can."""
        with self._lock:
            self.commands.forget(sender.name)
            self.state = self.state.disconnect(sender, others)
        self._wake()

    def fail(self, failure: JetbotError) -> None:
        """Make ``run`` end soon, and raise this."""
        self._failure = failure
        self.end()

    def end(self, *_) -> None:
        """Make ``run`` end soon; may be a signal handler."""
        self._ending = True
        self._wake()

    def _wake(self):
        if self._events.empty():  # one that the thread has not taken yet will do
            self._events.put(None)

    def _step_at_once(self):
        """Do a step in this thread; while another thread does one, leave it to the thread in ``run``."""
        if self._ending or not self._stepping.acquire(blocking=False):
            return self._wake()
        try:
            if not self._running or self.step(time.monotonic(), woken=True) < self._wakes_at:
                self._wake()
        except Exception as failure:  # the caller is rospy, which would only log it
            self.fail(failure)
        finally:
            self._stepping.release()

    def run(self) -> None:
        """Drive until ``end``, then close the robot. Raise JetbotError for what cannot be retried."""
        try:
            wait_until(lambda: self.robot.guarded or self._ending, GUARD_START_TIMEOUT)
            self.confirm(self.state.must_answer, time.monotonic())  # nobody was asked while the node started
            woken = self._running = True
            while not self._ending:
                with self._stepping:
                    if woken or time.monotonic() >= self._due_at:
                        self.step(time.monotonic(), woken)
                    self._wakes_at = self._due_at
                woken = self._sleep_until(self._wakes_at)
            if self._failure:
                raise self._failure
        finally:
            with self._stepping, contextlib.suppress(JetbotError):  # the guard reports it, and keeps trying
                self.robot.close()
                self.closed = True
            self._show(Step(time.monotonic(), self.state, None, STOPPED, self.robot.duties))

    def _sleep_until(self, moment):
        """Sleep until something happens, or until this moment; return whether something did."""
        with contextlib.suppress(queue.Empty):
            self._events.get(timeout=max(0.0, moment - time.monotonic()))
            return True
        return False

    def step(self, now: float, woken: bool) -> float:
        """Do all that is due at the time ``now``; return when the next step is, if nothing happens before.

        woken: whether something has just happened, such as a command.
        """
        if self._notice_freeze(now):
            if self.state.must_answer:  # no answer could arrive meanwhile: the time left for one stays
                self.confirm(self.state.must_answer, self.state.confirmed_at + now - self._due_at)
            self.robot.driver.invalidate()  # the guard may have stopped the wheels meanwhile
        self._stepped_at = now
        with self._lock:
            self.state = state = self.state.check_timeout(now)
        (self.asking.set if state.must_answer else self.asking.clear)()
        interval = self.robot.driver.keep_alive_interval if state.driving else STOPPED_INTERVAL
        due = now >= self._kept_up_at + (min(interval, UPKEEP_AFTER_COMMAND) if woken else interval)
        speeds, fault = self._try_to_drive(state, now, due)
        due = due or fault is NO_GUARD  # a heartbeat starts another guard
        if due:
            self._kept_up_at = now
            with contextlib.suppress(BusError):  # the next drive reports it
                self.robot.keep_alive()
        duties = self.robot.duties
        if self._ramp and not any(duties):
            self._ramp.reset()  # whatever has stopped the wheels
        self._show(Step(now, state, fault, speeds, duties), due)
        self._due_at = min(self._kept_up_at + interval, state.deadline, now + self._pause(fault))
        return self._due_at

    def _notice_freeze(self, now):
        """Return whether this program was frozen until now; what was sent meanwhile arrives now."""
        frozen = now - self._stepped_at > FREEZE
        if frozen:
            self._stale_until = now + STALE_FOR
        return frozen

    def _pause(self, fault):
        if fault:
            return RETRY_INTERVAL
        return STEP_INTERVAL if self._ramp and self._ramp.active else math.inf

    def _try_to_drive(self, state, now, verify):
        """Drive, or stop if there is no guard; return what was driven, and the fault."""
        try:
            if state.driving and not self.robot.guarded:
                self.robot.stop()
                return STOPPED, NO_GUARD
            speeds = self._ramp.limit(state.speeds, now) if self._ramp else state.speeds
            self.robot.set_motors(*speeds)
            if verify:
                self.robot.verify()
        except BusError as error:
            self.faults += not isinstance(self._step.fault, BusError)
            return STOPPED, error
        return speeds, None

    def _show(self, step, anyway=True):
        """Show a step to the watchers, if it differs from the last one."""
        last, self._step = self._step, step
        if anyway or (step.duties, step.speeds, step.fault, step.state.cause) != (
                last.duties, last.speeds, last.fault, last.state.cause):
            for watch in self.watchers:
                watch(step)
