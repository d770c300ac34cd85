"""The simulator: reads what the board commands, advances the model, publishes and prints its state."""

import math
import time
from collections import deque
from typing import Callable, Collection, Optional, Set

import rospy
from geometry_msgs.msg import Pose2D, PoseStamped
from nav_msgs.msg import Odometry, Path
from sensor_msgs.msg import JointState
from std_srvs.srv import Empty, EmptyResponse
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

from jetbot_ros.addresses import is_reachable, master_uri
from jetbot_ros.messages import frame_name, joint_states, odometry, transform
from jetbot_ros.xmlrpc import NO_ANSWER, proxy

from .diff_drive import PWM_FREQUENCY, DiffDriveModel, Pair, Pose
from .stall import StallReport

RATE = 50           # Hz
TOPICS = {"odom": Odometry, "joint_states": JointState}  # which the controller may publish instead
ANSWER_TIMEOUT = 1.0  # s, of the master
PATH_STEP = 0.05    # metres between two poses of the path
PATH_LENGTH = 1000  # poses; the oldest are dropped


class Simulator:
    """Drives the model at the speeds that ``wheel_speeds`` returns; publishes ``path``, tf, ``odom``, ``joint_states``.

    Its ``odom`` has no drift: the frame coincides with ``map``.
    pwm_frequency: returns that of the board in Hz, None where it is fixed.
    others: which of TOPICS another node publishes. The simulator never publishes the same; if the other appears later,
    it takes over. Odometry of its own starts at 0, where the robot is, and tf ``map -> true_base_footprint`` is then
    the robot's true pose.
    ``~set_pose`` and ``~reset`` hand a pose to the loop, which alone changes the model.
    """

    def __init__(self, model: DiffDriveModel, wheel_speeds: Callable[[], Pair],
                 pwm_frequency: Callable[[], Optional[float]], others: Collection[str]):
        self._model = model
        self._wheel_speeds, self._pwm_frequency = wheel_speeds, pwm_frequency
        self._start = model.pose
        self._new_pose = deque(maxlen=1)
        self._stepped_at = time.monotonic()
        self._printed = ""
        self._prefix = f"{rospy.get_namespace().strip('/')} ".lstrip()
        self._stall_report = StallReport()
        self._poses = deque(maxlen=PATH_LENGTH)
        self._others = {*others, *published_by_others()}
        self._publishers = {topic: rospy.Publisher(topic, TOPICS[topic], queue_size=10)
                            for topic in TOPICS if topic not in self._others}
        self._path = rospy.Publisher("path", Path, queue_size=1, latch=True)
        self._tf = TransformBroadcaster()
        self._static_tf = StaticTransformBroadcaster()
        self._place_odom(Pose() if "odom" in self._publishers else model.pose)
        rospy.Subscriber("~set_pose", Pose2D, self._on_set_pose, queue_size=1)
        rospy.Service("~reset", Empty, self._on_reset)

    def _on_set_pose(self, pose):
        if all(map(math.isfinite, (pose.x, pose.y, pose.theta))):
            self._new_pose.append(Pose(pose.x, pose.y, pose.theta))
        else:
            rospy.logwarn("A pose must be finite. The robot stays where it is.")

    def _on_reset(self, _):
        self._new_pose.append(self._start)
        return EmptyResponse()

    def spin(self) -> None:
        """Step and publish, and print once per second, until the node is shut down."""
        rospy.Timer(rospy.Duration(1.0), self._print_state)
        rospy.Timer(rospy.Duration(1.0), lambda _: self._others.update(published_by_others()))
        rate = rospy.Rate(RATE, reset=True)
        while not rospy.is_shutdown():
            for topic in self._others & set(self._publishers):
                self._hand_over(topic)
            self._step()
            self._publish()
            rate.sleep()

    def _hand_over(self, topic):
        self._publishers.pop(topic).unregister()
        if topic == "odom":
            self._place_odom(self._model.pose)
        rospy.loginfo(f"Another node publishes {topic}. The simulator no longer does.")

    def _place_odom(self, origin):
        """Publish where the odometry starts on the map."""
        self._static_tf.sendTransform(transform(rospy.Time.now(), "map", frame_name("odom"), origin))

    def _step(self):
        if self._new_pose:
            self._model.pose = self._new_pose.popleft()
            self._poses.clear()
        now = time.monotonic()
        frequency = self._pwm_frequency()
        self._model.step(self._wheel_speeds(), now - self._stepped_at, frequency or PWM_FREQUENCY)
        self._stepped_at = now
        stall = self._stall_report.update(self._model.stalled, frequency is None, now)
        if stall:
            rospy.logwarn(self._prefix + stall)

    def _publish(self):
        model = self._model
        stamp = rospy.Time.now()
        odom = odometry(stamp, model.pose, *model.velocity)
        frames = "map", frame_name("true_base_footprint")
        if "odom" in self._publishers:
            self._publishers["odom"].publish(odom)
            frames = odom.header.frame_id, odom.child_frame_id
        self._tf.sendTransform(transform(stamp, *frames, model.pose))
        if "joint_states" in self._publishers:
            self._publishers["joint_states"].publish(joint_states(stamp, *model.joints))
        odom.header.frame_id = "map"
        position, last = odom.pose.pose.position, self._poses[-1].pose.position if self._poses else None
        if last is None or math.hypot(position.x - last.x, position.y - last.y) >= PATH_STEP:
            self._poses.append(PoseStamped(odom.header, odom.pose.pose))
            self._path.publish(Path(odom.header, list(self._poses)))

    def _print_state(self, _):
        """Print pose and wheel speeds if they have changed, with two decimals and no -0.00."""
        pose, wheels = self._model.pose, (self._model.left.speed, self._model.right.speed)
        x, y, left, right = (f"{round(value, 2) + 0.0:.2f}" for value in (pose.x, pose.y, *wheels))
        state = (f"at x {x} m, y {y} m, heading {round(math.degrees(pose.yaw))} deg; "
                 f"left wheel {left} m/s, right wheel {right} m/s")
        if state != self._printed:
            self._printed = state
            print(self._prefix + state, flush=True)


def published_by_others() -> Set[str]:
    """Return which of TOPICS another node publishes; none while the master does not answer.

    The master still lists a node that was killed, but that one is not reachable.
    """
    master, name = proxy(master_uri(), ANSWER_TIMEOUT), rospy.get_name()
    try:
        publishers = dict(master.getSystemState(name)[2][0])
        return {topic for topic in TOPICS for other in publishers.get(rospy.resolve_name(topic), ())
                if other != name and is_reachable(master.lookupNode(name, other)[2])}
    except NO_ANSWER:
        return set()
