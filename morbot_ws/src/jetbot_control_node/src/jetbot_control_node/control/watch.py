"""Watches what a stop by a person needs: the ROS master, roslaunch, and the terminal. No rospy here."""

import math
import socket
import threading
import time
from typing import Callable

from jetbot import JetbotError
from jetbot_ros.launcher import Launcher
from jetbot_ros.master import NO_ANSWER
from jetbot_ros.state import NO_MASTER, SUSPENDED

from .supervisor import Step, Supervisor

POLL_INTERVAL = 0.25  # s between two looks at the launcher, at least
ASK_INTERVAL = 1.0    # s from an answer of the master to the next question
RETRY_INTERVAL = 0.2  # s after a question that failed; the second failure in a row counts
HANGING = 10.0        # s; a question that takes longer hangs, as where there is no memory for a thread


class LauncherWatch:
    """Holds the supervisor, which it watches, while the terminal is suspended, and ends it with roslaunch."""

    def __init__(self, supervisor: Supervisor, launcher: Launcher):
        self._supervisor, self._launcher = supervisor, launcher
        self._polled_at = -math.inf

    def __call__(self, step: Step) -> None:
        if step.at - self._polled_at < POLL_INTERVAL:
            return
        self._polled_at = step.at
        self._launcher.poll()
        set_hold(self._supervisor, SUSPENDED, self._launcher.suspended)
        if self._launcher.ended:
            self._supervisor.end()


class MasterWatch:
    """Holds the supervisor while the ROS master does not answer, or does not know this node.

    heal: as Links.heal; its time limit and ASK_INTERVAL are the longest that a frozen master goes unnoticed.
    """

    def __init__(self, supervisor: Supervisor, heal: Callable[[Callable[[], None]], bool]):
        self._supervisor, self._heal = supervisor, heal
        self._failures = 0  # in a row
        self._asked_at = time.monotonic()

    def ask(self) -> float:
        """Ask the master once; return the seconds until the next question."""
        self._asked_at = time.monotonic()
        try:  # a new master, which no emergency stop passes on yet, knows this node from the second time on
            self._failures = 0 if self._heal(self._hold) or self._heal(self._hold) else 2
        except socket.timeout:
            self._failures = 2
        except NO_ANSWER:  # the first time, the master may have been busy
            self._failures += 1
        if self._failures >= 2:
            self._hold()
        elif not self._failures:
            set_hold(self._supervisor, NO_MASTER, False)
        return RETRY_INTERVAL if self._failures else ASK_INTERVAL

    def __call__(self, step: Step) -> None:
        """Hold the supervisor while a question hangs."""
        if step.at - self._asked_at > HANGING:
            self._hold()

    def _hold(self):
        set_hold(self._supervisor, NO_MASTER, True)


def start(supervisor: Supervisor, heal: Callable[[Callable[[], None]], bool]) -> None:
    """Watch the launcher at each heartbeat of the supervisor, and the master, from a thread. heal: as Links.heal."""
    master = MasterWatch(supervisor, heal)
    supervisor.watchers.extend([LauncherWatch(supervisor, Launcher()), master])
    threading.Thread(target=repeat, args=[supervisor, master.ask], daemon=True).start()


def set_hold(supervisor: Supervisor, hold: str, engaged: bool) -> None:
    """Engage or release a hold; do not wake the supervisor if nothing changes."""
    if engaged != (hold in supervisor.state.holds):
        supervisor.hold(hold, engaged)


def repeat(supervisor: Supervisor, action: Callable[[], float]) -> None:
    """Call the action, with the pauses it returns, until the supervisor has ended; end that if the action fails."""
    try:
        while not supervisor.closed:
            time.sleep(action())
    except JetbotError as failure:
        supervisor.fail(failure)
    finally:
        supervisor.end()
