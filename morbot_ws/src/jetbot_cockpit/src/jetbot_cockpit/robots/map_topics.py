"""What a simulator and a judge publish for the map: where odometry starts, a robot's world and its course."""

from typing import Dict, Tuple

import rospy
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

from jetbot.kinematics import Pose, from_frame

from ..session.snapshot import Shape
from .reports import decode_shapes, yaw_of

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
