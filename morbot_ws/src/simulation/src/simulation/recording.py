"""What a robot was commanded and what it did, from its topics or from a rosbag."""

import contextlib
import math
from time import monotonic
from typing import Iterable, List, NamedTuple, Tuple, Union

import rosbag
import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

from jetbot import files
from jetbot.wait import wait_until

from .diff_drive import Pose

ODOMETRY_TIMEOUT = 3.0  # s without odometry, then there is no robot to record


class Recording(NamedTuple):
    """The robot's velocities, its pose at each of them, and the commands. Times are in s."""

    velocities: List[Tuple[float, Twist]]
    poses: List[Pose]
    commands: List[Tuple[float, Twist]]


def read_bag(file: str, odom: str, cmd_vel: str) -> Recording:
    """Return what a rosbag holds on these topics; raise OSError or ROSBagException if it cannot be read."""
    types = {odom: Odometry._type, cmd_vel: Twist._type}
    files.check_regular(file)  # rosbag waits for a FIFO
    try:
        with rosbag.Bag(file) as bag:  # its topics are as their publishers wrote them: odom or /odom
            return make_recording((time.to_sec(), message) for topic, message, time in bag.read_messages()
                                  if types.get("/" + topic.lstrip("/")) == message._type)
    except rosbag.ROSBagUnindexedException:  # its recorder was killed
        raise rosbag.ROSBagException(f"the recording of {file} was cut short. Fix it: rosbag reindex {file}") from None
    except Exception as error:  # rosbag raises many kinds for a damaged file
        raise rosbag.ROSBagException(f"{file} cannot be read as a rosbag: {error}") from None


def record(odom: str, cmd_vel: str, seconds: float) -> Recording:
    """Return what these topics carry for some seconds, or until Ctrl-C, or until no odometry arrives at first.

    Makes this process a node until then; a master must be running.
    """
    messages, deadline = [], monotonic() + seconds
    with contextlib.suppress(KeyboardInterrupt):
        rospy.init_node("draw_track", anonymous=True, disable_signals=True)
        for topic, kind in (odom, Odometry), (cmd_vel, Twist):
            rospy.Subscriber(topic, kind, lambda message: messages.append((rospy.get_time(), message)))
        if wait_until(lambda: any(message._type == Odometry._type for _, message in messages), ODOMETRY_TIMEOUT):
            wait_until(rospy.is_shutdown, deadline - monotonic())
    rospy.signal_shutdown("the recording ends")
    return make_recording(list(messages))


def make_recording(messages: Iterable[Tuple[float, Union[Odometry, Twist]]]) -> Recording:
    """Return the recording of messages, each with the time in s at which it arrived."""
    recording = Recording([], [], [])
    for time, message in messages:
        if message._type == Twist._type:
            recording.commands.append((time, message))
        else:
            recording.velocities.append((message.header.stamp.to_sec(), message.twist.twist))
            recording.poses.append(pose_of(message))
    return recording


def pose_of(message: Odometry) -> Pose:
    """Return the pose of a robot on a flat floor."""
    position, orientation = message.pose.pose.position, message.pose.pose.orientation
    return Pose(position.x, position.y, math.remainder(2 * math.atan2(orientation.z, orientation.w), math.tau))
