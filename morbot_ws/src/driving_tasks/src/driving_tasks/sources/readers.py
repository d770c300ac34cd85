"""Who looks in a task by camera alone: at the camera, as one must, or at what it keeps closed."""

import re
import time
from typing import Iterator, Optional

import rospy

from jetbot.sentence import Sentence
from jetbot.text import printable
from jetbot_ros.contract import GROUND_TRUTH
from jetbot_ros.master import NO_ANSWER, condition_of, system_state
from jetbot_ros.processes import command_of

from ..scoring.sentences import say

CLOSED = ("line", "odom", "path", "joint_states", GROUND_TRUTH)  # of the robot
CAMERA = "camera/image_raw/compressed"
# Programs that show it, and drive nothing; what they are called, where their program is on another computer.
WATCHERS = re.compile(r".*/(jetbot_cockpit/(scripts/)?cockpit\.py|(bin|rviz)/rviz|rosbag/record|"
                      r"robot_state_publisher/robot_state_publisher)")
NAMES = re.compile(r".*/(jetbot_cockpit|robot_state_publisher|(rviz|record)(_\d+)*)")
ASK_INTERVAL = 1.0  # s
MAX_BLIND = 4       # answers in a row, while the robot moves, in which nobody looks: wait_for_message often looks away


class Readers:
    """problem: a sentence on the first who reads what is closed, or None; as of the last ``poll``.

    namespace: the robot's.
    """

    def __init__(self, namespace: str):
        self._closed, self._camera = [*(f"{namespace}/{name}" for name in CLOSED), "/tf"], f"{namespace}/{CAMERA}"
        self._asked_at, self._blind = 0.0, 0
        self.problem: Optional[Sentence] = None

    def start(self) -> None:
        """Forget that nobody has looked."""
        self._blind = 0

    @property
    def are_blind(self) -> bool:
        """Whether the robot moves, and no program looks at its camera."""
        return self._blind >= MAX_BLIND

    def poll(self, moves: bool) -> None:
        """Ask the master once per ASK_INTERVAL; call it as often as you like. moves: whether the robot does."""
        if time.monotonic() - self._asked_at < ASK_INTERVAL:
            return
        try:
            subscribers = system_state()[1]
            self.problem = next((say("reads_closed", program=printable(node), topic=topic)
                                 for topic in self._closed for node in self._programs(subscribers, topic)), None)
            self._blind = 0 if any(self._programs(subscribers, self._camera)) else self._blind + moves
        except NO_ANSWER:  # what drives notices that, too
            pass
        self._asked_at = time.monotonic()

    def _programs(self, subscribers, topic) -> Iterator[str]:
        return (node for node in subscribers.get(topic, ()) if not is_watcher(node) and condition_of(node))


def is_watcher(node: str) -> bool:
    """Return whether the node is this one, or a program that only shows what it reads."""
    command = command_of(node)
    return (node == rospy.get_name() or any(WATCHERS.fullmatch(str(path)) for path in command)
            or not command and bool(NAMES.fullmatch(node)))
