"""All robots on the ROS master: stops or releases them with one message, and reports what each one answers."""

from typing import Dict, List

import rospy
from diagnostic_msgs.msg import DiagnosticStatus
from std_msgs.msg import Bool

from jetbot.wait import wait_until
from jetbot_ros import contract, rospy_repairs
from jetbot_ros.announcer import Announcer
from jetbot_ros.master import address_of, is_reachable, system_state
from jetbot_ros.state import EMERGENCY_STOP, UNKNOWN, RobotState, read

ASK_INTERVAL = 0.05  # s between two questions to the master


class Fleet:
    """The nodes that listen to the emergency stop and publish a status. Makes this process a node."""

    def __init__(self, engaged: bool):
        rospy_repairs.repair()
        rospy.init_node("emergency_stop", anonymous=True, disable_rosout=True, disable_signals=True)
        self._engaged = engaged
        self._publisher = rospy.Publisher(contract.STOP, Bool, queue_size=1, latch=True)  # for those that join later
        self._publisher.publish(engaged)
        self._announcer = Announcer(self._publisher)
        self._listeners = 0
        self.states: Dict[str, RobotState] = {}  # of each robot's node, UNKNOWN until it arrives

    def wait(self, timeout: float) -> bool:
        """Return whether there are robots, and all confirm the emergency stop, or its release, within so many s.

        A robot that was stopped before confirms at once: the message must reach it too, and a cockpit, which has to
        know who stopped it. Raise NO_ANSWER if the master does not answer.
        """
        return wait_until(lambda: self._find_robots() and self._has_reached_all() and not self.unconfirmed(),
                          timeout, ASK_INTERVAL)

    def unconfirmed(self) -> List[str]:
        """Return the nodes whose state is not the wanted one, or is not known."""
        return [name for name, state in self.states.items()
                if state is UNKNOWN or (state.cause == EMERGENCY_STOP) != self._engaged]

    def remove_dead(self) -> None:
        """Remove the silent nodes that have ended, and are only still registered with the master."""
        for name in [name for name, state in self.states.items() if state is UNKNOWN]:
            uri = address_of(name)
            if not uri or not is_reachable(uri):
                del self.states[name]

    def _has_reached_all(self):
        return sum(bool(each.stat_num_msg) for each in self._publisher.impl.connections) >= self._listeners

    def leave(self) -> None:
        """Unregister this node; the robots keep what they were told."""
        rospy.signal_shutdown("done")

    def _find_robots(self):
        """Tell who listens of the stop, and subscribe to the state of new robots; return all."""
        publishers, subscribers, _ = graph = system_state()
        self._announcer.announce(graph)
        self._listeners = len(subscribers.get(contract.STOP, ()))
        for name in subscribers.get(contract.STOP, ()):
            if name in publishers.get(f"{name}/status", ()) and name not in self.states:
                self.states[name] = UNKNOWN
                rospy.Subscriber(f"{name}/state", DiagnosticStatus, self._record, name)
        return self.states

    def _record(self, message, name):
        self.states[name] = read(message)
