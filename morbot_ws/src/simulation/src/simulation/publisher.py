"""The state of a simulated robot as ROS messages."""

import math
from collections import deque

import rospy
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry, Path
from sensor_msgs.msg import JointState
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

from jetbot_ros.messages import frame_name, odometry, transform

from .diff_drive import DiffDriveModel
from .pose import Pose

JOINTS = ["left_wheel_joint", "right_wheel_joint"]  # as in jetbot.urdf
PATH_STEP = 0.05    # metres between two poses of the path
PATH_LENGTH = 1000  # poses; the oldest are dropped


class StatePublisher:
    """Publishes ``joint_states``, ``path``, tf and, where the controller does not, ``odom``.

    All robots share one frame ``map``. This odometry has no drift: every odom frame coincides with it.
    """

    def __init__(self, publish_odom: bool):
        self._odom = rospy.Publisher("odom", Odometry, queue_size=10) if publish_odom else None
        self._joint_states = rospy.Publisher("joint_states", JointState, queue_size=10)
        self._path = rospy.Publisher("path", Path, queue_size=1, latch=True)
        self._poses = deque(maxlen=PATH_LENGTH)
        self._tf = TransformBroadcaster()
        self._static_tf = StaticTransformBroadcaster()
        self._static_tf.sendTransform(transform(rospy.Time.now(), "map", frame_name("odom"), Pose()))

    def publish(self, model: DiffDriveModel) -> None:
        """Publish the state of the model now; the path, where it has become longer."""
        odom = odometry(rospy.Time.now(), model.pose, *model.velocity)
        if self._odom:
            self._odom.publish(odom)
        self._joint_states.publish(JointState(odom.header, JOINTS, model.wheel_angles, model.wheel_rates, []))
        self._tf.sendTransform(transform(odom.header.stamp, odom.header.frame_id, odom.child_frame_id, model.pose))
        self._extend_path(odom)

    def _extend_path(self, odom):
        position, last = odom.pose.pose.position, self._poses[-1].pose.position if self._poses else None
        if last is None or math.hypot(position.x - last.x, position.y - last.y) >= PATH_STEP:
            self._poses.append(PoseStamped(odom.header, odom.pose.pose))
            self._path.publish(Path(odom.header, list(self._poses)))

    def clear_path(self) -> None:
        """Start a new path with the next pose."""
        self._poses.clear()
