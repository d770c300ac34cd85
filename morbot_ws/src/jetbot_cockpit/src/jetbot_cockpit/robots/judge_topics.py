"""The judge that runs beside the cockpit: which tasks it offers, and the robots that it is asked to judge."""

from typing import Tuple

import rospy
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

from jetbot.text import printable
from jetbot_ros.contract import JUDGE_REQUESTS, JUDGE_TASKS

from .reports import MAX_TITLE

MAX_TASKS = 30


class Judge:
    """Needs an initialized node. No method blocks."""

    def __init__(self):
        self._tasks: Tuple[Tuple[str, str], ...] = ()
        self._subscriber = rospy.Subscriber(JUDGE_TASKS, DiagnosticStatus, self._on_tasks)
        self._requests = rospy.Publisher(JUDGE_REQUESTS, KeyValue, queue_size=100)

    def tasks(self) -> Tuple[Tuple[str, str], ...]:
        """Return (name, title) of each task that a judge offers now."""
        return self._tasks if self._subscriber.get_num_connections() else ()

    def request(self, robot: str, task: str, request: str) -> None:
        """Ask for a robot to be put at the start of a task, and judged; task "" ends that.

        request: a word that the judge's reports about it repeat.
        """
        self._requests.publish(robot, f"{task} {request}".strip())

    def _on_tasks(self, message):
        self._tasks = tuple((printable(each.key)[:MAX_TITLE], printable(each.value)[:MAX_TITLE])
                            for each in message.values[:MAX_TASKS])
