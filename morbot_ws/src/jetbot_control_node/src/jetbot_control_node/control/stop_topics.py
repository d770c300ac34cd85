"""The topics that stop the robot, whatever is commanded: one stops all robots, the other this one alone."""

import rospy
from std_msgs.msg import Bool

from jetbot_ros import contract
from jetbot_ros.state import EMERGENCY_STOP, OWN_EMERGENCY_STOP

from .commanders import Commanders
from .supervisor import Supervisor

TOPICS = {contract.STOP: EMERGENCY_STOP, "~emergency_stop": OWN_EMERGENCY_STOP}


class EmergencyStop:
    """Holds the robot from a true on the topic until the next false."""

    def __init__(self, topic: str, hold: str, supervisor: Supervisor):
        self._hold, self._supervisor = hold, supervisor
        self._commanders = Commanders(topic)
        rospy.Subscriber(topic, Bool, self._callback, queue_size=1, tcp_nodelay=True)

    def _callback(self, msg):
        if msg.data:
            self._supervisor.hold(self._hold, True)
        sender = self._commanders.sender(msg)
        if not msg.data and sender and not sender.old:  # one from before this node's start, or an interruption, is old
            self._supervisor.hold(self._hold, False)

    def settle(self) -> None:
        """Wait for what was latched before this node started, a second at most; a stop is then in force."""
        if any(msg.data for msg in self._commanders.settle()):
            self._supervisor.hold(self._hold, True)


def subscribe(supervisor: Supervisor) -> None:
    """Subscribe to TOPICS; on return, an earlier emergency stop is in force."""
    for stop in [EmergencyStop(topic, hold, supervisor) for topic, hold in TOPICS.items()]:
        stop.settle()
