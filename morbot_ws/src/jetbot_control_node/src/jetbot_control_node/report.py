"""What the node reports: its latched status, log lines and /diagnostics."""

import contextlib
import math
import queue
import time
from typing import Dict

import rospy
from diagnostic_msgs.msg import DiagnosticStatus
from diagnostic_updater import Updater
from std_msgs.msg import String

from jetbot.boards import MotorDriver

from .safety import State
from .summary import start_line, start_warnings, status_suffix, summary
from .supervisor import Supervisor
from .supply_watch import SupplyWatch

DIAGNOSTICS_INTERVAL = 1.0  # s
REPEAT_LOG = 1.0            # s before the same line is logged again


class Report:
    """``change`` publishes the status at once, from any thread; ``spin`` logs in the main thread, which may wait."""

    def __init__(self, parameters: Dict[str, object], driver: MotorDriver, supply: SupplyWatch):
        self._summary, self._warnings = summary(parameters, driver), start_warnings(parameters, driver)
        self._link, self._suffix, self._supply = driver.link, status_suffix(driver), supply
        self._status_publisher = rospy.Publisher("~status", String, latch=True, queue_size=1)
        self._status_changes = queue.Queue(maxsize=10)
        name = rospy.get_namespace().strip("/")
        self._prefix = f"{name}: " if name else ""
        self._logged = {}  # {status: time in s}
        self._last = None
        self._ended = False
        self._counted = (0, time.monotonic())

    def change(self, state: State) -> None:
        """Publish a status that differs from the one before."""
        self._publish(state.status)
        with contextlib.suppress(queue.Full):  # the terminal blocks the main thread, which then logs the latest only
            self._status_changes.put_nowait(state)

    def end(self) -> None:
        """Publish the last status, and end ``spin``."""
        self._ended = True
        self._publish("stopped: the controller has ended")
        with contextlib.suppress(queue.Full):
            self._status_changes.put_nowait(None)

    def _publish(self, status):
        self._status_publisher.publish(status + self._suffix)

    def spin(self, supervisor: Supervisor) -> None:
        """Log and publish diagnostics until the node ends."""
        rospy.loginfo(self._prefix + start_line(self._summary))
        for warning in self._warnings:
            rospy.logwarn(self._prefix + warning)
        updater = Updater()
        updater.setHardwareID(self._summary["bus"])
        updater.add("motors", lambda result: self._diagnose(result, supervisor))
        due = 0.0
        while not (self._ended or rospy.is_shutdown()):
            state = self._next_change(due - time.monotonic())
            self._log(state or supervisor.state)
            if time.monotonic() >= due:
                due = time.monotonic() + DIAGNOSTICS_INTERVAL
                updater.force_update()

    def _next_change(self, timeout):
        with contextlib.suppress(queue.Empty):
            return self._status_changes.get(timeout=max(0.0, timeout))
        return None

    def _log(self, state):
        now = time.monotonic()
        if state.status != self._last and now - self._logged.get(state.status, -math.inf) >= REPEAT_LOG:
            self._logged[state.status] = now
            self._last = state.status
            (rospy.logwarn if state.warning else rospy.loginfo)(self._prefix + state.status + self._suffix)

    def _diagnosis(self, state):
        """Return the level and the message of /diagnostics, which a status reports only for a while."""
        lasting = self._supply.warning
        level = (DiagnosticStatus.ERROR if state.fault else
                 DiagnosticStatus.WARN if state.warning or lasting else DiagnosticStatus.OK)
        addition = f", {lasting}" if lasting and lasting not in state.status else ""
        return level, state.status + addition + self._suffix

    def _diagnose(self, result, supervisor):
        now, state = time.monotonic(), supervisor.state
        result.summary(*self._diagnosis(state))
        for name, text in self._summary.items():
            result.add(name, text)
        result.add("transfers", self._link.transfers)
        result.add("failed transfers", self._link.errors)
        disturbances = supervisor.disturbances
        result.add("settings lost", disturbances["resets"])
        result.add("writes of other programs", disturbances["overwritten"])
        result.add("times without an answer", disturbances["faults"])
        result.add("supply", str(self._supply))
        result.add("supply dips", self._supply.dips)
        result.add("commanded by", state.sender.name if state.sender else "nobody yet")
        (commands, since), self._counted = self._counted, (state.commands, now)
        result.add("commands per second", f"{(state.commands - commands) / (now - since):.1f}")
        at = state.commanded_at
        result.add("age of the last command (s)", "none yet" if at is None else f"{now - at:.2f}")
        return result
