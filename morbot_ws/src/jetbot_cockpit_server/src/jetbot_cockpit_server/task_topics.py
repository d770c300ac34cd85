"""What a judge and a simulator publish for the map: a robot's task, its course and its world."""

import math
import time
from typing import Optional, Tuple

import genpy
import rospy
from diagnostic_msgs.msg import DiagnosticStatus
from visualization_msgs.msg import MarkerArray

from . import scene, task
from .frames import Frames

MAX_BYTES = 200_000    # of a message; 1,000 points need less
DECODE_INTERVAL = 0.5  # s between two drawings of a topic: pages need no more, and are sent each one


class Drawing:
    """The shapes of one topic, decoded when they are shown; a drawing that is published again is decoded once."""

    def __init__(self, topic: str, frames: Frames):
        self._frames, self._message, self._bytes = frames, None, b""
        self._shapes, self._decoded_at = (), -math.inf
        self.subscriber = rospy.Subscriber(topic, rospy.AnyMsg, self._on_message, queue_size=1)

    @property
    def is_published(self) -> bool:
        """Whether its publisher lives, as far as the connection shows."""
        return self.subscriber.get_num_connections() > 0

    def shapes(self, now: float) -> Tuple[scene.Shape, ...]:
        """Return what the topic draws."""
        message = self._message
        if message and message._buff != self._bytes and now - self._decoded_at >= DECODE_INTERVAL:
            markers = decoded(message, MarkerArray)
            self._shapes = scene.decode(markers.markers, self._frames.on_map) if markers else ()
            self._bytes, self._decoded_at = message._buff, now
        return self._shapes

    def _on_message(self, message):
        self._message = message


class TaskTopics:
    """Subscribes to them. base: the robot's namespace without a slash at its end."""

    def __init__(self, base: str, frames: Frames):
        self._tracker = task.TaskTracker()
        self._world, self._course = Drawing(f"{base}/world", frames), Drawing(f"{base}/task_course", frames)
        self._subscriber = rospy.Subscriber(f"{base}/task", rospy.AnyMsg, self._on_task, queue_size=1)

    def close(self) -> None:
        """End all subscriptions."""
        for subscriber in (self._subscriber, self._world.subscriber, self._course.subscriber):
            subscriber.unregister()

    def forget_result(self) -> None:
        """The robot was put back to its start: a result is no longer shown."""
        self._tracker.forget_result()

    def snapshot(self, now: float) -> Tuple[Tuple[scene.Shape, ...], Optional[task.Task]]:
        """Return the shapes around the robot, and its task; a course is drawn only with a task."""
        current = self._tracker.current(self._subscriber.get_num_connections() > 0, now)
        world = self._world.shapes(now) if self._world.is_published else ()
        return world + (self._course.shapes(now) if current else ()), current

    def _on_task(self, message):
        status = decoded(message, DiagnosticStatus)
        if status:
            values = {item.key: item.value for item in status.values}
            self._tracker.update(task.decode(status.name, status.message, values), time.monotonic())


def decoded(message: rospy.AnyMsg, kind: type) -> Optional[genpy.Message]:
    """Return a message of this type; None if it is another program's, of another type, or too large."""
    if message._connection_header.get("type") != kind._type or len(message._buff) > MAX_BYTES:
        return None
    try:
        return kind().deserialize(message._buff)
    except (genpy.DeserializationError, ValueError):
        return None
