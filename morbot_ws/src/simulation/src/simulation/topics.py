"""What the simulator publishes: the robot as the controller would, where it really is, and the world around it."""

import math
from collections import deque
from typing import Collection, Iterator

import rospy
from geometry_msgs.msg import Point, PoseStamped
from geometry_msgs.msg import Pose as RosPose
from nav_msgs.msg import Odometry, Path
from rosgraph.names import namespace, resolve_name
from sensor_msgs.msg import JointState
from std_msgs.msg import ColorRGBA, Float32MultiArray, Header, MultiArrayDimension, MultiArrayLayout, String
from tf2_msgs.msg import TFMessage  # without tf2_ros, which takes 5 MB
from visualization_msgs.msg import Marker, MarkerArray

from jetbot_ros import contract
from jetbot_ros.ros_messages import frame_name, joint_states, odometry, quaternion, transform

from .diff_drive import DiffDriveModel, Pose
from .world import EYES, World

PATH_STEP = 0.05     # m between two poses of the path
PATH_LENGTH = 1000   # poses; the oldest are dropped
WALL_WIDTH = 0.01    # m, as drawn
HEIGHT = 0.001       # m, as drawn: above the floor, below the robot's path
WALL_COLOR, LINE_COLOR = ColorRGBA(0.55, 0.25, 0.15, 1.0), ColorRGBA(0.1, 0.1, 0.1, 1.0)
EYES_LAYOUT = MultiArrayLayout([MultiArrayDimension(", ".join(EYES), len(EYES), len(EYES))], 0)


class Topics:
    """Publishes a simulated robot: ``path``, ``world``, how its body differs from the shipped one (``~body``), and each
    of the others while somebody subscribes.

    node: the name of its simulator, in its namespace; static_transform: what to publish on /tf_static.
    others: those of ``odom`` and ``joint_states`` that the controller publishes. The simulator's ``odom`` has no drift:
    its frame coincides with ``map``. The controller's starts at 0, where the robot is, and tf
    ``map -> true_base_footprint`` is then the true pose.
    """

    def __init__(self, node: str, others: Collection[str], model: DiffDriveModel):
        drifts, robot = "odom" in others, namespace(node)
        odom, base, true_base = (frame_name(name, robot) for name in ("odom", "base_footprint", "true_base_footprint"))
        frames = ("map", true_base) if drifts else (odom, base)
        rows = {
            "odom": (Odometry, lambda stamp, model: odometry(stamp, model.pose, *model.velocity, robot)),
            "joint_states": (JointState, lambda stamp, model: joint_states(stamp, *model.joints)),
            "~ground_truth": (Odometry, lambda stamp, model: ground_truth(stamp, model, robot)),
            "line": (Float32MultiArray,
                     lambda _, model: Float32MultiArray(EYES_LAYOUT, model.world.line_sensor(model.pose))),
            "/tf": (TFMessage, lambda stamp, model: TFMessage([transform(stamp, *frames, model.pose)]))}
        self._live = [(rospy.Publisher(resolve_name(topic, node), kind, queue_size=10), message_of)
                      for topic, (kind, message_of) in rows.items() if topic not in others]
        self._path, self._world, self._body = (
            rospy.Publisher(resolve_name(topic, node), kind, queue_size=1, latch=True)
            for topic, kind in (("path", Path), (contract.WORLD, MarkerArray), ("~body", String)))
        self._body.publish(model.body.changes)
        self.static_transform = transform(rospy.Time.now(), "map", odom, model.pose if drifts else Pose())
        self._poses = deque(maxlen=PATH_LENGTH)
        self.draw(model.world)

    def draw(self, world: World) -> None:
        """Publish what a world looks like."""
        self._world.publish(MarkerArray(list(markers(world))))

    def clear_path(self) -> None:
        """Let the path begin where the robot is next."""
        self._poses.clear()

    def publish(self, stamp: rospy.Time, model: DiffDriveModel) -> None:
        """Publish where the robot is, how it moves, and what its line sensor sees."""
        for publisher, message_of in self._live:
            if publisher.get_num_connections():
                publisher.publish(message_of(stamp, model))
        self._extend_path(Header(stamp=stamp, frame_id="map"), model.pose)

    def _extend_path(self, header, pose):
        last = self._poses[-1].pose.position if self._poses else None
        if last is None or math.hypot(pose.x - last.x, pose.y - last.y) >= PATH_STEP:
            self._poses.append(PoseStamped(header, RosPose(Point(pose.x, pose.y, 0.0), quaternion(pose.yaw))))
            self._path.publish(Path(header, list(self._poses)))


def ground_truth(stamp: rospy.Time, model: DiffDriveModel, robot: str) -> Odometry:
    """Return the true pose, on the map, of the robot in this namespace."""
    message = odometry(stamp, model.pose, *model.velocity, robot)
    message.header.frame_id = "map"
    return message


def markers(world: World) -> Iterator[Marker]:
    """Yield the markers that draw a world, after one that clears what was drawn before."""
    yield Marker(action=Marker.DELETEALL)
    for kind, polylines, width, color in (("walls", world.walls, WALL_WIDTH, WALL_COLOR),
                                          ("lines", world.lines, world.line_width, LINE_COLOR)):
        for number, polyline in enumerate(polylines):
            marker = Marker(ns=kind, id=number, type=Marker.LINE_STRIP, color=color)
            marker.header.frame_id = "map"
            marker.scale.x, marker.pose.orientation.w = width, 1.0
            marker.points = [Point(x, y, HEIGHT) for x, y in polyline]
            yield marker
