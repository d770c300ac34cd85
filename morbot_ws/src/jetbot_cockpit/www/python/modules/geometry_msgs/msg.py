"""geometry_msgs, as its .msg files say."""

import std_msgs.msg  # noqa: F401
from genpy import define

define("geometry_msgs", globals(), """
Vector3 float64 x, float64 y, float64 z
Point float64 x, float64 y, float64 z
Point32 float32 x, float32 y, float32 z
Quaternion float64 x, float64 y, float64 z, float64 w
Pose Point position, Quaternion orientation
Pose2D float64 x, float64 y, float64 theta
PoseArray Header header, Pose[] poses
PoseWithCovariance Pose pose, float64[36] covariance
Polygon Point32[] points
Transform Vector3 translation, Quaternion rotation
Twist Vector3 linear, Vector3 angular
TwistWithCovariance Twist twist, float64[36] covariance
Accel Vector3 linear, Vector3 angular
Wrench Vector3 force, Vector3 torque
Vector3Stamped Header header, Vector3 vector
PointStamped Header header, Point point
QuaternionStamped Header header, Quaternion quaternion
PoseStamped Header header, Pose pose
PoseWithCovarianceStamped Header header, PoseWithCovariance pose
TransformStamped Header header, string child_frame_id, Transform transform
TwistStamped Header header, Twist twist
AccelStamped Header header, Accel accel
WrenchStamped Header header, Wrench wrench
""")
