"""What a judge and a simulator publish for the map: where odometry starts, a robot's task, its course, its world."""

import time
from typing import Dict, Optional, Tuple

import rospy
from diagnostic_msgs.msg import DiagnosticStatus
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

from jetbot.kinematics import Pose, from_frame

from ..session.snapshot import Shape, Task
from .reports import TaskTracker, decode_shapes, decode_task, yaw_of

MAP = "map"


class Frames:
    """The frames whose pose on the map is static."""

    def __init__(self):
        self._origins: Dict[str, Pose] = {}
        rospy.Subscriber("/tf_static", TFMessage, self._on_transforms)

    def on_map(self, frame: str, pose: Pose) -> Pose:
        """Return a pose in this frame as one on the map; a frame that is not known coincides with the map."""
        origin = self._origins.get(frame.lstrip("/"), Pose())
        return Pose(*from_frame(origin, pose[:2]), origin.yaw + pose.yaw)

    def _on_transforms(self, message):
        for each in message.transforms:
            if each.header.frame_id.lstrip("/") == MAP:
                start, rotation = each.transform.translation, each.transform.rotation
                self._origins[each.child_frame_id.lstrip("/")] = Pose(start.x, start.y, yaw_of(rotation))


class Drawing:
    """The shapes of one topic."""

    def __init__(self, topic: str, frames: Frames):
        self._frames, self._shapes = frames, ()
        self.subscriber = rospy.Subscriber(topic, MarkerArray, self._on_markers, queue_size=1)

    def shapes(self) -> Tuple[Shape, ...]:
        """Return what the topic draws while its publisher lives, as far as the connection shows."""
        return self._shapes if self.subscriber.get_num_connections() else ()

    def _on_markers(self, message):
        self._shapes = decode_shapes(message.markers, self._frames.on_map)


class MapTopics:
    """Subscribes to the topics of one robot. base: its namespace without a slash at its end."""

    def __init__(self, base: str, frames: Frames):
        self._tracker = TaskTracker()
        self._world, self._course = Drawing(f"{base}/world", frames), Drawing(f"{base}/task_course", frames)
        self._subscriber = rospy.Subscriber(f"{base}/task", DiagnosticStatus, self._on_task, queue_size=1)

    def close(self) -> None:
        """End all subscriptions."""
        for subscriber in (self._subscriber, self._world.subscriber, self._course.subscriber):
            subscriber.unregister()

    def snapshot(self, now: float) -> Tuple[Tuple[Shape, ...], Optional[Task]]:
        """Return the shapes around the robot, and its task."""
        return (self._world.shapes() + self._course.shapes(),
                self._tracker.current(self._subscriber.get_num_connections() > 0, now))

    def _on_task(self, message):
        values = {item.key: item.value for item in message.values}
        self._tracker.update(decode_task(message.name, message.message, values), time.monotonic())
