"""Who reads what a task by camera alone keeps closed: where the robot is, and what its line sensor sees."""

import re
import time
from typing import Iterator

from jetbot.text import printable
from jetbot_ros.master import NO_ANSWER, condition_of, system_state

CLOSED = ("line", "odom", "path", "joint_states", "jetbot_simulator/ground_truth")  # of the robot
WATCHERS = re.compile(  # they show it, and drive nothing
    r".*/(judge|jetbot_cockpit|robot_state_publisher|(rviz|record|draw_track)(_\d+)*)")
ASK_INTERVAL = 1.0  # s


class Readers:
    """problem: a sentence on the first of them, "" without; as of the last ``poll``. namespace: the robot's."""

    def __init__(self, namespace: str):
        self._closed, self._asked_at, self.problem = [*(f"{namespace}/{name}" for name in CLOSED), "/tf"], 0.0, ""

    def poll(self) -> None:
        """Ask the master once per ASK_INTERVAL; call it as often as you like."""
        if time.monotonic() - self._asked_at < ASK_INTERVAL:
            return
        try:
            self.problem = next(self._problems(system_state()[1]), "")
        except NO_ANSWER:  # what drives notices that, too
            pass
        self._asked_at = time.monotonic()

    def _problems(self, subscribers) -> Iterator[str]:
        for topic in self._closed:
            for node in subscribers.get(topic, ()):
                if not WATCHERS.fullmatch(node) and condition_of(node):
                    yield f"{printable(node)} reads {topic}. End it: in this task, programs see with the camera alone."
