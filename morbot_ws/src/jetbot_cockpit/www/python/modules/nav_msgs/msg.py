"""nav_msgs, as its .msg files say: what a robot without a map has."""

import geometry_msgs.msg  # noqa: F401
from _start import lacking
from genpy import define

__getattr__ = lacking("nav_msgs.msg")
define("nav_msgs", globals(), """
Odometry Header header, string child_frame_id, _/PoseWithCovariance pose, _/TwistWithCovariance twist
Path Header header, _/PoseStamped[] poses
""".replace("_/", "geometry_msgs/"))
