"""The emergency stops: of all robots, and of one."""

import contextlib

import rospy
from std_msgs.msg import Bool


class EmergencySwitch:
    """An emergency stop: a latched topic, published by this node and others. engaged: its newest value."""

    def __init__(self, topic: str):
        self.engaged = False
        self._latched = False
        self._publisher = rospy.Publisher(topic, Bool, queue_size=1, latch=True)
        self._subscriber = rospy.Subscriber(topic, Bool, self._on_message)

    def set(self, engaged: bool) -> None:
        """Publish it; robots that start later obey it too."""
        self.engaged = self._latched = engaged
        with contextlib.suppress(rospy.ROSException):  # closed: the robot has ended meanwhile, or this node
            self._publisher.publish(engaged)

    def close(self) -> None:
        """End the publisher and the subscriber."""
        self._publisher.unregister()
        self._subscriber.unregister()

    def _on_message(self, message):
        if message._connection_header.get("callerid") == rospy.get_name():
            return
        self.engaged = message.data
        if self._latched and not message.data:  # else a robot that starts later would be stopped by a stop that is over
            self.set(False)
