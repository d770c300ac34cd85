"""What the robot publishes, of what the page knows."""

import json
import math

from _start import senses as ask


def senses():
    """Return what the robot senses now, by its name; None is not known."""
    return json.loads(ask())


def floats(numbers):
    """Return numbers as JavaScript writes them, 1.0 being 1, as ROS's messages have them."""
    return tuple(map(float, numbers))


def odometry(message, known):
    x, y, yaw = floats(known["pose"])
    message.header.stamp, message.header.frame_id = type(message.header.stamp).now(), "odom"
    message.child_frame_id = "base_footprint"
    pose, twist = message.pose.pose, message.twist.twist
    pose.position.x, pose.position.y = x, y
    pose.orientation.z, pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    twist.linear.x, twist.angular.z = floats(known.get("speed") or (0, 0))


def line(message, known):
    message.data = floats(known["line"])


def wheels(message, known):
    message.data = floats(known.get("command") or (0, 0)) + floats(known["wheels"])


# topic: its type, what of the senses it needs, and what fills its message
TOPICS = {
    "odom": ("nav_msgs/Odometry", "pose", odometry),
    "line": ("std_msgs/Float32MultiArray", "line", line),
    "jetbot_controller/wheels": ("std_msgs/Float32MultiArray", "wheels", wheels),
}
