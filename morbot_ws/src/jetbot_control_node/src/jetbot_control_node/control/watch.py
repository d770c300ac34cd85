"""Watches what a stop by a person needs: the ROS master, roslaunch, and the terminal. No rospy here."""

import threading
import time
from typing import Callable

from jetbot import JetbotError
from jetbot_ros import failures
from jetbot_ros.holds import NO_MASTER, SUSPENDED, Hold
from jetbot_ros.launcher import Launcher
from jetbot_ros.master import NO_ANSWER

from .supervisor import Supervisor

POLL_INTERVAL = 0.25  # s
ASK_INTERVAL = 1.0    # s from an answer of the master to the next question
RETRY_INTERVAL = 0.2  # s after a question that failed; the second failure in a row counts
SILENT_POLLS = 9      # without an answer until the master counts as frozen: 2.5 s at most


class MasterWatch:
    """Whether the ROS master answers and knows this node. ``ask`` may block; ``poll`` never does.

    heal: as Links.heal.
    """

    def __init__(self, heal: Callable[[], bool]):
        self._heal = heal
        self._answers = 0   # only ``ask`` writes these
        self._failures = 0
        self._seen = 0      # only ``poll`` writes these
        self._silent = 0    # polls: while this process is suspended, none is counted
        self._back = threading.Event()

    def poll(self) -> bool:
        """Return whether the master is lost; call it every POLL_INTERVAL."""
        self._silent = self._silent + 1 if self._answers == self._seen else 0
        self._seen = self._answers
        return self._failures >= 2 or self._silent >= SILENT_POLLS

    def ask(self) -> float:
        """Ask the master once; return the seconds until the next question."""
        try:
            if not self._heal():
                self._failures = 2  # a new master, which no emergency stop passes on yet
                if not self._heal():
                    return RETRY_INTERVAL
        except NO_ANSWER:
            self._failures += 1
            return RETRY_INTERVAL
        was_lost, self._failures = self._failures, 0
        self._answers += 1
        if was_lost:
            self._back.set()
        return ASK_INTERVAL

    def wait(self, seconds: float) -> None:
        """Wait until the next ``poll``; not after the master is back, when commands may come at once."""
        self._back.wait(seconds)
        self._back.clear()


def start(supervisor: Supervisor, master: MasterWatch) -> None:
    """Hold the supervisor while the master is lost or the terminal suspended, and end it with roslaunch."""
    launcher = Launcher()
    check(supervisor, launcher, master)
    for action, wait in (lambda: check(supervisor, launcher, master), master.wait), (master.ask, time.sleep):
        threading.Thread(target=repeat, args=[supervisor, action, wait], daemon=True).start()


def check(supervisor: Supervisor, launcher: Launcher, master: MasterWatch) -> float:
    """Check all once; return the seconds until the next check."""
    launcher.poll()
    failures.check_starts()
    set_hold(supervisor, SUSPENDED, launcher.suspended)
    set_hold(supervisor, NO_MASTER, master.poll())
    if launcher.ended:
        supervisor.end()
    return POLL_INTERVAL


def set_hold(supervisor: Supervisor, hold: Hold, engaged: bool) -> None:
    """Engage or release a hold; do not wake the supervisor if nothing changes."""
    if engaged != (hold in supervisor.state.holds):
        supervisor.hold(hold, engaged)


def repeat(supervisor: Supervisor, action: Callable[[], float], wait: Callable[[float], None] = time.sleep) -> None:
    """Call the action, with the pauses it returns, until the supervisor has ended; end that if the action fails."""
    try:
        while not supervisor.closed:
            wait(action())
    except JetbotError as failure:
        supervisor.fail(failure)
    finally:
        supervisor.end()
