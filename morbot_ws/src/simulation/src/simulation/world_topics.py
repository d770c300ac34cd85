"""The topics of the simulated world: what it looks like, where the robot really is in it, and what it sees of it."""

from collections import deque
from typing import Iterator, Optional

import rospy
from geometry_msgs.msg import Point
from nav_msgs.msg import Odometry
from std_msgs.msg import ColorRGBA, Float32MultiArray, MultiArrayDimension, MultiArrayLayout, String
from visualization_msgs.msg import Marker, MarkerArray

from jetbot import InvalidValue
from jetbot.text import printable
from jetbot_ros.messages import odometry

from . import line_sensor
from .diff_drive import DiffDriveModel
from .world import World
from .worlds import parse

WALL_WIDTH = 0.01  # m, as drawn
WALL_COLOR, LINE_COLOR = ColorRGBA(0.55, 0.25, 0.15, 1.0), ColorRGBA(0.1, 0.1, 0.1, 1.0)
HEIGHT = 0.001     # m, as drawn: above the floor, below the robot's path
EYES = MultiArrayLayout([MultiArrayDimension(", ".join(line_sensor.EYES), len(line_sensor.EYES),
                                             len(line_sensor.EYES))], 0)


class WorldTopics:
    """Publishes ``world``, and, to those who subscribe, ``~ground_truth`` and ``line``; subscribes to ``~world``.

    start: the world at first, and again where ``~world`` is empty.
    """

    def __init__(self, start: World):
        self._start = self._world = start
        self._new = deque([start], maxlen=1)
        self._drawing = rospy.Publisher("world", MarkerArray, queue_size=1, latch=True)
        self._ground_truth = rospy.Publisher("~ground_truth", Odometry, queue_size=10)
        self._line = rospy.Publisher("line", Float32MultiArray, queue_size=10)
        rospy.Subscriber("~world", String, self._on_world, queue_size=1)

    def _on_world(self, message):
        try:
            self._new.append(parse(message.data, "the world that was sent") if message.data else self._start)
        except InvalidValue as error:
            rospy.logwarn(f"{printable(error)} It stays as it is.")

    def new_world(self) -> Optional[World]:
        """Return the world that has come since the last call, and draw it; None if there is none."""
        if not self._new:
            return None
        self._world = self._new.popleft()
        self._drawing.publish(MarkerArray(list(markers(self._world))))
        return self._world

    def publish(self, stamp: rospy.Time, model: DiffDriveModel) -> None:
        """Publish where the robot is and what its line sensor sees, to those who subscribe."""
        if self._ground_truth.get_num_connections():
            message = odometry(stamp, model.pose, *model.velocity)
            message.header.frame_id = "map"
            self._ground_truth.publish(message)
        if self._line.get_num_connections():
            self._line.publish(Float32MultiArray(EYES, line_sensor.read(self._world, model.pose)))


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
