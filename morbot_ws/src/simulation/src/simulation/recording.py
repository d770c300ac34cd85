"""What a robot was commanded and what it did, from its topics or from a rosbag."""

import math
from typing import List, NamedTuple

import rosbag
import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

from jetbot.wait import wait_until


class Sample(NamedTuple):
    """The state of the robot at a time in s: pose in m and rad, velocity in m/s and rad/s."""

    time: float
    x: float
    y: float
    yaw: float
    linear: float
    angular: float


class Command(NamedTuple):
    """The velocity that was commanded at a time in s, in m/s and rad/s."""

    time: float
    linear: float
    angular: float


class Recording:
    """Lists of ``samples`` and ``commands``, each in the order of arrival."""

    def __init__(self):
        self.samples: List[Sample] = []
        self.commands: List[Command] = []

    def add_odometry(self, odometry: Odometry) -> None:
        """Append a Sample."""
        position, orientation = odometry.pose.pose.position, odometry.pose.pose.orientation
        yaw, twist = 2 * math.atan2(orientation.z, orientation.w), odometry.twist.twist
        self.samples.append(Sample(odometry.header.stamp.to_sec(), position.x, position.y, yaw,
                                   twist.linear.x, twist.angular.z))

    def add_command(self, twist: Twist, time: rospy.Time) -> None:
        """Append a Command."""
        self.commands.append(Command(time.to_sec(), twist.linear.x, twist.angular.z))


def read_bag(file: str, odom: str, cmd_vel: str) -> Recording:
    """Return what a rosbag holds on these topics; raise ROSBagException where it cannot be read."""
    recording = Recording()
    try:
        with rosbag.Bag(file) as bag:
            for topic, message, time in bag.read_messages():
                name = "/" + topic.lstrip("/")  # rosbag keeps names as they were typed
                if (name, message._type) == (odom, Odometry._type):
                    recording.add_odometry(message)
                elif (name, message._type) == (cmd_vel, Twist._type):
                    recording.add_command(message, time)
    except rosbag.ROSBagUnindexedException:  # its recorder was killed
        raise rosbag.ROSBagException(f"the recording of {file} was cut short. Fix it: rosbag reindex {file}") from None
    return recording


def record(odom: str, cmd_vel: str, seconds: float) -> Recording:
    """Return what these topics carry for some seconds, or until Ctrl-C."""
    recording = Recording()
    rospy.init_node("draw_track", anonymous=True)
    subscribers = [rospy.Subscriber(odom, Odometry, recording.add_odometry),
                   rospy.Subscriber(cmd_vel, Twist, lambda twist: recording.add_command(twist, rospy.Time.now()))]
    wait_until(rospy.is_shutdown, timeout=seconds)
    for subscriber in subscribers:
        subscriber.unregister()
    return recording
