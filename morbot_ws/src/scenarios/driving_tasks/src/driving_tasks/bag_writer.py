"""Writes what a robot did while it was judged into a rosbag that can be judged again."""

import tempfile
from collections import deque
from pathlib import Path

import rosbag
import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

from jetbot import files

from .robot import SimulatedRobot

MAX_MESSAGES = 100_000  # of each topic; the oldest are dropped


class BagWriter:
    """Holds the ground truth that is added, and the commands that arrive, since the last ``clear``."""

    def __init__(self, robot: SimulatedRobot):
        self._robot = robot
        self._truth, self._commands = deque(maxlen=MAX_MESSAGES), deque(maxlen=MAX_MESSAGES)
        rospy.Subscriber(robot.command_topic, Twist, lambda twist: self._commands.append((rospy.Time.now(), twist)))

    def clear(self) -> None:
        """Drop what there is."""
        self._commands.clear()
        self._truth.clear()

    def add(self, message: Odometry) -> None:
        """Add a message of the ground truth."""
        self._truth.append(message)

    def save(self, file: str) -> None:
        """Write the rosbag in one step. Raises OSError."""
        with tempfile.TemporaryDirectory() as folder:
            bag_file = Path(folder, "drive.bag")
            with rosbag.Bag(str(bag_file), "w") as bag:
                for message in self._truth:
                    bag.write(self._robot.truth_topic, message, message.header.stamp)
                for time, twist in list(self._commands):
                    bag.write(self._robot.command_topic, twist, time)
            files.replace(file, bag_file.read_bytes())
