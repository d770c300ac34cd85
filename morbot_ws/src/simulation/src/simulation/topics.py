"""What the simulator publishes unless the controller does: ``odom`` with its tf, and ``joint_states``."""

from typing import Collection, Set

import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage  # without tf2_ros, which takes 5 MB

from jetbot_ros.master import NO_ANSWER, condition_of, system_state
from jetbot_ros.messages import frame_name, joint_states, odometry, transform

from .diff_drive import DiffDriveModel, Pose

TOPICS = {"odom": Odometry, "joint_states": JointState}
POLL_INTERVAL = 1.0   # s between two looks at who publishes them; with many robots, each is work for the master


class SharedTopics:
    """Publishes those of TOPICS that no other node publishes, and tf, each while somebody subscribes.

    others: which of them another node will publish; one that appears later takes over. The simulator's ``odom`` has no
    drift: its frame coincides with ``map``. Another's starts at 0, where the robot is, and tf
    ``map -> true_base_footprint`` is then the true pose.
    """

    def __init__(self, others: Collection[str], pose: Pose):
        self._others = {*others, *published_by_others()}
        self._publishers = {topic: rospy.Publisher(topic, TOPICS[topic], queue_size=10)
                            for topic in TOPICS if topic not in self._others}
        self._tf = rospy.Publisher("/tf", TFMessage, queue_size=10)
        self._static_tf = rospy.Publisher("/tf_static", TFMessage, queue_size=10, latch=True)
        self._place_odom(Pose() if "odom" in self._publishers else pose)
        rospy.Timer(rospy.Duration(POLL_INTERVAL), lambda _: self._others.update(published_by_others()))

    def publish(self, stamp: rospy.Time, model: DiffDriveModel) -> None:
        """Publish where the robot is and how it moves, to those who subscribe."""
        for topic in self._others & set(self._publishers):
            self._hand_over(topic, model.pose)
        if self._is_wanted("odom"):
            self._publishers["odom"].publish(odometry(stamp, model.pose, *model.velocity))
        if self._is_wanted("joint_states"):
            self._publishers["joint_states"].publish(joint_states(stamp, *model.joints))
        if self._tf.get_num_connections():
            frames = ((frame_name("odom"), frame_name("base_footprint")) if "odom" in self._publishers else
                      ("map", frame_name("true_base_footprint")))
            self._tf.publish(TFMessage([transform(stamp, *frames, model.pose)]))

    def _is_wanted(self, topic):
        return topic in self._publishers and self._publishers[topic].get_num_connections()

    def _hand_over(self, topic, pose):
        self._publishers.pop(topic).unregister()
        if topic == "odom":
            self._place_odom(pose)
        rospy.loginfo(f"Another node publishes {topic}. The simulator no longer does.")

    def _place_odom(self, origin):
        """Publish where the odometry starts on the map."""
        self._static_tf.publish(TFMessage([transform(rospy.Time.now(), "map", frame_name("odom"), origin)]))


def published_by_others() -> Set[str]:
    """Return which of TOPICS another node publishes; none while the master does not answer.

    The master still lists a node that was killed, but that one has ended.
    """
    name = rospy.get_name()
    try:
        publishers, _, _ = system_state()
        return {topic for topic in TOPICS for other in publishers.get(rospy.resolve_name(topic), ())
                if other != name and condition_of(other)}
    except NO_ANSWER:
        return set()
