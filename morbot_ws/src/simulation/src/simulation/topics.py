"""What the simulator publishes: the robot as the controller would, where it really is, and the world around it."""

import math
from collections import deque
from typing import Collection, Iterator, Set

import rospy
from geometry_msgs.msg import Point, PoseStamped
from geometry_msgs.msg import Pose as RosPose
from nav_msgs.msg import Odometry, Path
from sensor_msgs.msg import JointState
from std_msgs.msg import ColorRGBA, Float32MultiArray, Header, MultiArrayDimension, MultiArrayLayout
from tf2_msgs.msg import TFMessage  # without tf2_ros, which takes 5 MB
from visualization_msgs.msg import Marker, MarkerArray

from jetbot_ros.master import NO_ANSWER, condition_of, system_state
from jetbot_ros.messages import frame_name, joint_states, odometry, quaternion, transform

from .diff_drive import DiffDriveModel, Pose
from .world import EYES, World

SHARED = {"odom": Odometry, "joint_states": JointState}  # that the controller may publish
POLL_INTERVAL = 1.0  # s between two looks at who publishes them; with many robots, each is work for the master
PATH_STEP = 0.05     # m between two poses of the path
PATH_LENGTH = 1000   # poses; the oldest are dropped
WALL_WIDTH = 0.01    # m, as drawn
HEIGHT = 0.001       # m, as drawn: above the floor, below the robot's path
WALL_COLOR, LINE_COLOR = ColorRGBA(0.55, 0.25, 0.15, 1.0), ColorRGBA(0.1, 0.1, 0.1, 1.0)
EYES_LAYOUT = MultiArrayLayout([MultiArrayDimension(", ".join(EYES), len(EYES), len(EYES))], 0)


class SharedTopics:
    """Publishes those of SHARED that no other node publishes, and tf, each while somebody subscribes.

    others: which of them another node will publish; one that appears later takes over. The simulator's ``odom`` has no
    drift: its frame coincides with ``map``. Another's starts at 0, where the robot is, and tf
    ``map -> true_base_footprint`` is then the true pose.
    """

    def __init__(self, others: Collection[str], pose: Pose):
        self._others = {*others, *published_by_others()}
        self._publishers = {topic: rospy.Publisher(topic, SHARED[topic], queue_size=10)
                            for topic in SHARED if topic not in self._others}
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
    """Return which of SHARED another node publishes; none while the master does not answer.

    The master still lists a node that was killed, but that one has ended.
    """
    name = rospy.get_name()
    try:
        publishers, _, _ = system_state()
        return {topic for topic in SHARED for other in publishers.get(rospy.resolve_name(topic), ())
                if other != name and condition_of(other)}
    except NO_ANSWER:
        return set()


class TrueTopics:
    """Publishes ``path`` and ``world``, and, to those who subscribe, ``~ground_truth`` and ``line``."""

    def __init__(self, world: World):
        self._ground_truth = rospy.Publisher("~ground_truth", Odometry, queue_size=10)
        self._line = rospy.Publisher("line", Float32MultiArray, queue_size=10)
        self._path = rospy.Publisher("path", Path, queue_size=1, latch=True)
        self._world = rospy.Publisher("world", MarkerArray, queue_size=1, latch=True)
        self._poses = deque(maxlen=PATH_LENGTH)
        self.draw(world)

    def draw(self, world: World) -> None:
        """Publish what a world looks like."""
        self._world.publish(MarkerArray(list(markers(world))))

    def clear_path(self) -> None:
        """Let the path begin where the robot is next."""
        self._poses.clear()

    def publish(self, stamp: rospy.Time, model: DiffDriveModel) -> None:
        """Publish where the robot is and what its line sensor sees."""
        if self._ground_truth.get_num_connections():
            message = odometry(stamp, model.pose, *model.velocity)
            message.header.frame_id = "map"
            self._ground_truth.publish(message)
        if self._line.get_num_connections():
            self._line.publish(Float32MultiArray(EYES_LAYOUT, model.world.line_sensor(model.pose)))
        self._extend_path(Header(stamp=stamp, frame_id="map"), model.pose)

    def _extend_path(self, header, pose):
        last = self._poses[-1].pose.position if self._poses else None
        if last is None or math.hypot(pose.x - last.x, pose.y - last.y) >= PATH_STEP:
            self._poses.append(PoseStamped(header, RosPose(Point(pose.x, pose.y, 0.0), quaternion(pose.yaw))))
            self._path.publish(Path(header, list(self._poses)))


def markers(world: World) -> Iterator[Marker]:
    """Yield the markers that draw a world, after one that clears what was drawn before."""
    yield Marker(action=Marker.DELETEALL)
    for namespace, polylines, width, color in (("walls", world.walls, WALL_WIDTH, WALL_COLOR),
                                               ("lines", world.lines, world.line_width, LINE_COLOR)):
        for number, polyline in enumerate(polylines):
            marker = Marker(ns=namespace, id=number, type=Marker.LINE_STRIP, color=color)
            marker.header.frame_id = "map"
            marker.scale.x, marker.pose.orientation.w = width, 1.0
            marker.points = [Point(x, y, HEIGHT) for x, y in polyline]
            yield marker
