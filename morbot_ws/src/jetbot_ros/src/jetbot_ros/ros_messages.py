"""Messages and frame names of a robot (REP 103, REP 105), as the controller and the simulator publish them."""

import math
from typing import Optional, Sequence

import rospy
from geometry_msgs.msg import Quaternion, TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CameraInfo, JointState

from jetbot.camera.lens import focal_length
from jetbot.kinematics import Pose

JOINTS = ["left_wheel_joint", "right_wheel_joint"]  # as in simulation/urdf/jetbot.urdf


def frame_name(name: str, namespace: Optional[str] = None) -> str:
    """Return the name of one of a robot's frames, prefixed by its namespace: red/odom in /red/; None: the node's."""
    return (rospy.get_namespace() if namespace is None else namespace)[1:] + name


def quaternion(yaw: float) -> Quaternion:
    """Return the rotation by ``yaw`` radians about the z axis."""
    return Quaternion(z=math.sin(yaw / 2), w=math.cos(yaw / 2))


def pose_of(message: Odometry) -> Pose:
    """Return the pose of a robot on a flat floor."""
    position, orientation = message.pose.pose.position, message.pose.pose.orientation
    return Pose(position.x, position.y, math.remainder(2 * math.atan2(orientation.z, orientation.w), math.tau))


def odometry(stamp: rospy.Time, pose, linear: float = 0.0, angular: float = 0.0,
             namespace: Optional[str] = None) -> Odometry:
    """Return the robot's pose (x, y in m, yaw in rad) in its odom frame, and its own velocity in m/s and rad/s.

    namespace: as for ``frame_name``.
    """
    message = Odometry(child_frame_id=frame_name("base_footprint", namespace))
    message.header.stamp, message.header.frame_id = stamp, frame_name("odom", namespace)
    message.pose.pose.position.x, message.pose.pose.position.y = pose.x, pose.y
    message.pose.pose.orientation = quaternion(pose.yaw)
    message.twist.twist.linear.x, message.twist.twist.angular.z = linear, angular
    return message


def joint_states(stamp: rospy.Time, angles: Sequence[float], rates: Sequence[float]) -> JointState:
    """Return the rotations of the wheels (left, right) in rad, and their angular speeds in rad/s."""
    message = JointState(name=JOINTS, position=angles, velocity=rates)
    message.header.stamp = stamp
    return message


def transform(stamp: rospy.Time, parent: str, child: str, pose) -> TransformStamped:
    """Return the pose (x, y in m, yaw in rad) of the child frame in its parent."""
    message = TransformStamped(child_frame_id=child)
    message.header.stamp, message.header.frame_id = stamp, parent
    message.transform.translation.x, message.transform.translation.y = pose.x, pose.y
    message.transform.rotation = quaternion(pose.yaw)
    return message


def camera_info(width: int, height: int, namespace: Optional[str] = None) -> CameraInfo:
    """Return the model of a camera with pictures of this size in pixels: a pinhole without distortion.

    namespace: as for ``frame_name``.
    """
    focal, across, down = focal_length(height), (width - 1) / 2, (height - 1) / 2  # from the middle of the first pixel
    info = CameraInfo(height=height, width=width, distortion_model="plumb_bob", D=[0.0] * 5,
                      R=[1, 0, 0, 0, 1, 0, 0, 0, 1], K=[focal, 0, across, 0, focal, down, 0, 0, 1],
                      P=[focal, 0, across, 0, 0, focal, down, 0, 0, 0, 1, 0])
    info.header.frame_id = frame_name("camera_optical", namespace)  # as in simulation/urdf/jetbot.urdf
    return info
