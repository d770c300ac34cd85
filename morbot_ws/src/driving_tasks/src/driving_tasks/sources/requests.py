"""Judges robots on request: each one that a page asks for, as often as it asks.

The page's programs do not see the camera: the tasks that are driven by camera alone are judge.py's.
"""

import contextlib
import time
from collections import deque
from typing import Callable, Deque, Dict, List, Optional, Tuple

import rospy
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

from jetbot.sentence import Sentence
from jetbot.text import printable
from jetbot_ros import links, rospy_repairs
from jetbot_ros.contract import CLASS_JUDGE, JUDGE_REQUESTS, JUDGE_TASKS
from jetbot_ros.master import NO_ANSWER, require_master

from ..report.announcement import CANCELLED, Announcement
from ..report.marks import to_csv
from ..scoring.sentences import say
from ..scoring.tasks import TASKS
from .attempt import Attempt
from .judged_robot import JudgedRobot, label, simulated_robots
from .live import close, other_judges, polls

OFFERED = {task.name: task for task in TASKS.values() if not task.by_camera}
DRIVE_TIMEOUT = 60.0  # s from a request until the robot must drive
LINGER = 2.0          # s after a result until it is not published any more, and another judge may judge the robot


def serve() -> None:
    """Judge until Ctrl-C. Raise JetbotError if the master ends."""
    require_master("roslaunch jetbot_class class.launch")
    rospy_repairs.repair()
    rospy.init_node(CLASS_JUDGE, argv=[], disable_signals=True)  # rospy's own handlers would ask the master
    links.stay_linked()
    tasks = rospy.Publisher(JUDGE_TASKS, DiagnosticStatus, queue_size=1, latch=True)
    tasks.publish(name="tasks", values=[KeyValue(task.name, task.title) for task in OFFERED.values()])
    judge = ClassJudge()
    try:
        for _ in polls():
            judge.step(time.monotonic())
    finally:
        close(judge.judging())


class ClassJudge:
    """Judges each robot's newest request. ``step`` does what is due, and never waits for a robot."""

    def __init__(self):
        self._requests: Deque[KeyValue] = deque(maxlen=100)
        self._robots: Dict[str, JudgedRobot] = {}  # by namespace; a robot that was judged is followed from then on
        self._attempts: Dict[str, Tuple[Attempt, float]] = {}  # with the time of the request
        self._closing: List[Tuple[float, Callable[[], None]]] = []  # what is due later
        rospy.Subscriber(JUDGE_REQUESTS, KeyValue, self._requests.append)

    def judging(self) -> List[JudgedRobot]:
        """Return the robots that are judged now."""
        return [attempt.robot for attempt, _ in self._attempts.values()]

    def step(self, now: float) -> None:
        """Begin what was asked for, and go on with it; call it every POLL_INTERVAL."""
        while self._requests:
            message = self._requests.popleft()
            name, _, request = message.value.partition(" ")
            (self._begin if name else self._cancel)(message.key.rstrip("/"), name, request, now)
        for namespace, robot in self._robots.items():
            if namespace not in self._attempts:
                robot.poll()
        for namespace, (attempt, since) in list(self._attempts.items()):
            attempt.step()
            if not attempt.mark and not attempt.has_driven and now - since > DRIVE_TIMEOUT:
                attempt.finish()
            if attempt.mark:
                self._end(namespace, now)
        for due in [each for each in self._closing if each[0] <= now]:
            self._closing.remove(due)
            due[1]()

    def _begin(self, namespace, name, request, now):
        """Put a robot to the start of a task. An attempt that it replaces gets no score."""
        if name not in OFFERED or namespace not in self._running():
            return
        refusal = refuse(namespace)
        if refusal:
            announcement = Announcement(namespace, OFFERED[name], request)
            announcement.publish(CANCELLED, refusal)
            self._closing.append((now + LINGER, announcement.close))
            return
        if namespace not in self._robots:
            self._robots[namespace] = JudgedRobot(namespace)
        robot = self._robots[namespace]
        robot.poll()  # what has interrupted the last drive interrupts no other one
        before = self._attempts.get(namespace)
        self._attempts[namespace] = Attempt(OFFERED[name], robot, lambda sentence: None, request), now
        if before:
            before[0].close()

    def _cancel(self, namespace, _name, _request, now):
        """End a robot's attempt without a score: the program that drives it was stopped."""
        if namespace in self._attempts:
            attempt, _ = self._attempts[namespace]
            attempt.step()  # what has interrupted the drive before is the reason
            if not attempt.mark:
                attempt.cancel(say("not_counted_program_stopped"))
            self._end(namespace, now)

    def _running(self):
        with contextlib.suppress(*NO_ANSWER):
            return simulated_robots()
        return []

    def _end(self, namespace, now):
        attempt, _ = self._attempts.pop(namespace)
        attempt.robot.set_world("")
        self._closing.append((now + LINGER, attempt.close))
        if attempt.mark.result:
            print(to_csv((), [attempt.mark.row]), end="", flush=True)


def refuse(namespace: str) -> Optional[Sentence]:
    """Return why this robot cannot be judged here, or None."""
    try:
        others = other_judges([namespace])
    except NO_ANSWER:
        return say("no_master")
    return next((say("other_judge", judge=printable(node), robot=label(namespace)) for node, _ in others), None)
