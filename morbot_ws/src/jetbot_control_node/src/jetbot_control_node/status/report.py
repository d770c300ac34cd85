"""Publishes the latched status and state, and /diagnostics, and logs."""

import contextlib
import math
import queue
import time
from typing import Dict

import rospy
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from diagnostic_updater import Updater
from std_msgs.msg import String

from jetbot.health import BAD, OK, WARNING, judge, worst
from jetbot.wait import wait_until
from jetbot_ros.state import ENDED, RobotState, because, sentence

from ..control.supervisor import Supervisor
from ..supply.supply_watch import SupplyWatch
from .health_watch import HealthWatch
from .notes import Status, StatusWatch
from .summary import start_line, start_warnings, status_suffix, summary

DIAGNOSTICS_INTERVAL = 1.0  # s
LEVELS = {OK: DiagnosticStatus.OK, WARNING: DiagnosticStatus.WARN, BAD: DiagnosticStatus.ERROR}
SEND_TIMEOUT = 0.2          # s for the last status to be sent
REPEAT_LOG = 1.0            # s before the same line is logged again


class Report:
    """Publishes a supervisor's status and state at once; ``spin`` logs it in the main thread, which may wait."""

    def __init__(self, parameters: Dict[str, object], supervisor: Supervisor, supply: SupplyWatch,
                 health: HealthWatch):
        driver = supervisor.robot.driver
        self._summary, self._start_warnings = summary(parameters, driver), start_warnings(parameters, driver)
        self._supervisor, self._supply, self._health = supervisor, supply, health
        self._suffix = status_suffix(driver)
        self._status_publisher = rospy.Publisher("~status", String, latch=True, queue_size=1)
        self._state_publisher = rospy.Publisher("~state", DiagnosticStatus, latch=True, queue_size=1)
        self._published = ""
        self._changes = queue.Queue(maxsize=10)
        name = rospy.get_namespace().strip("/")
        self._prefix = f"{name}: " if name else ""
        self._logged = {}  # {status: time in s}
        self._last = None
        self._ended = False
        self._counted = (0, time.monotonic())
        self._watch = StatusWatch(supervisor, self._change, supply.note)
        supervisor.watchers.append(self._watch)

    def _change(self, status: Status):
        self._publish(status.data, self._level(status))
        with contextlib.suppress(queue.Full):  # the terminal blocks the main thread, which then logs the latest only
            self._changes.put_nowait(status)

    def end(self) -> None:
        """Publish the last status, and end ``spin``."""
        self._ended = True
        self._publish(RobotState(ENDED, sentence(because(ENDED)), ENDED, remarks=()), DiagnosticStatus.OK)
        # rospy sends from other threads, and its shutdown, which follows, would drop what they have not sent
        connections = [*self._status_publisher.impl.connections, *self._state_publisher.impl.connections]
        wait_until(lambda: not any(each._queue for each in connections), SEND_TIMEOUT)
        with contextlib.suppress(queue.Full):
            self._changes.put_nowait(None)

    def _publish(self, state, level):
        bus, text = self._summary["bus"], state.sentence + self._suffix
        values = [KeyValue(*item) for item in state._replace(bus=bus).values().items()]
        self._state_publisher.publish(DiagnosticStatus(
            level, f"{rospy.get_name()[1:]}: state", state.sentence, bus, values))
        if text != self._published:
            self._published = text
            self._status_publisher.publish(text)

    def spin(self) -> None:
        """Log and publish diagnostics until the node ends."""
        rospy.loginfo(self._prefix + start_line(self._summary))
        for warning in self._start_warnings:
            rospy.logwarn(self._prefix + warning)
        updater = Updater()
        updater.setHardwareID(self._summary["bus"])
        updater.add("motors", self._diagnose)
        updater.add("health", self._diagnose_health)
        due = 0.0
        while not (self._ended or rospy.is_shutdown()):
            self._log(self._next_change(due - time.monotonic()) or self._watch.status)
            if time.monotonic() >= due:
                due = time.monotonic() + DIAGNOSTICS_INTERVAL
                updater.force_update()

    def _next_change(self, timeout):
        with contextlib.suppress(queue.Empty):
            return self._changes.get(timeout=max(0.0, timeout))
        return None

    def _log(self, status):
        now, text = time.monotonic(), status.text
        if text != self._last and now - self._logged.get(text, -math.inf) >= REPEAT_LOG:
            self._logged[text] = now
            self._last = text
            (rospy.logwarn if status.warning else rospy.loginfo)(self._prefix + text + self._suffix)

    def _diagnose(self, result):
        status = self._watch.status
        result.summary(self._level(status), status.text + self._suffix)
        for name, text in {**self._summary, **self._counts()}.items():
            result.add(name, text)
        return result

    def _diagnose_health(self, result):
        """Say how the robot is; its terminal reads what is not in order, too."""
        readings = self._health.readings(time.monotonic())
        rows = judge(readings)
        for row in self._health.news(rows):
            rospy.logwarn(self._prefix + str(row))
        result.summary(LEVELS[worst(rows)], " ".join(map(str, rows)) or "Nothing is measured.")
        for name, value in readings.items():
            result.add(name, f"{value:g}")
        return result

    @staticmethod
    def _level(status):
        return (DiagnosticStatus.ERROR if status.fault else
                DiagnosticStatus.WARN if status.warning else DiagnosticStatus.OK)

    def _counts(self):
        now, state, driver = time.monotonic(), self._supervisor.state, self._supervisor.robot.driver
        (commands, since), self._counted = self._counted, (self._supervisor.commands.count, now)
        return {
            "transfers": driver.link.transfers,
            "failed transfers": driver.link.errors,
            "settings lost": driver.resets,
            "writes of other programs": driver.overwritten,
            "times without an answer": self._supervisor.faults,
            "supply": self._supply,
            "supply dips": self._supply.dips,
            "commanded by": state.sender.name if state.sender else "nobody yet",
            "commands per second": f"{(self._counted[0] - commands) / (now - since):.1f}",
            "age of the last command (s)":
                "none yet" if state.commanded_at is None else f"{now - state.commanded_at:.2f}",
        }
