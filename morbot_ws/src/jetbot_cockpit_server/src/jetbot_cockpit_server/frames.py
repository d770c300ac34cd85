"""Where the robots' odometry starts on the map, by the static transforms."""

import math
from typing import Dict, Tuple

import rospy
from tf2_msgs.msg import TFMessage

from jetbot import kinematics
from jetbot.kinematics import from_frame

MAP = "map"
MAX_FRAMES = 1000
Pose = Tuple[float, float, float]  # x, y in m, yaw in rad


class Frames:
    """The frames whose pose on the map is static."""

    def __init__(self):
        self._origins: Dict[str, Pose] = {}
        rospy.Subscriber("/tf_static", TFMessage, self._on_transforms)

    def on_map(self, frame: str, pose: Pose) -> Pose:
        """Return a pose in this frame as one on the map; a frame that is not known coincides with the map."""
        origin = kinematics.Pose(*self._origins.get(frame.lstrip("/"), (0.0, 0.0, 0.0)))
        x, y, yaw = pose
        return (*from_frame(origin, (x, y)), origin.yaw + yaw)

    def _on_transforms(self, message):
        for each in message.transforms:
            child, transform = each.child_frame_id.lstrip("/"), each.transform
            known = child in self._origins or len(self._origins) < MAX_FRAMES
            if each.header.frame_id.lstrip("/") == MAP and known:
                self._origins[child] = transform.translation.x, transform.translation.y, yaw_of(transform.rotation)


def yaw_of(rotation) -> float:
    """Return the angle in rad of a rotation about the z axis."""
    return 2 * math.atan2(rotation.z, rotation.w)
