#!/usr/bin/env python3
"""Draws where a robot drove, and how fast, into a PNG file."""

import argparse
import os
import sys

import rosbag
import rosgraph
import rospy

from jetbot import files
from jetbot.text import printable
from jetbot_ros.master import require_master
from simulation.drawing import draw
from simulation.recording import read_bag, record

MAX_SECONDS = 3600


def duration(text: str) -> float:
    """Return the number of seconds; raise ValueError unless it is above 0 and at most MAX_SECONDS."""
    if not 0 < float(text) <= MAX_SECONDS:
        raise ValueError
    return float(text)


def robot(text: str) -> str:
    """Return the namespace of a robot without its slashes; raise ValueError for one that ROS does not take."""
    if not rosgraph.names.is_legal_name(text):
        raise ValueError
    return text.strip("/")


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("png", nargs="?", default="track.png")
    source = parser.add_mutually_exclusive_group()
    source.add_argument("--bag", help="a rosbag with odom and cmd_vel")
    source.add_argument("--seconds", type=duration, default=20,
                        help=f"how long to record the robot that drives now, {MAX_SECONDS} at most (default: 20)")
    parser.add_argument("--robot", type=robot, default="", help="the robot's namespace")
    return parser.parse_args(rospy.myargv()[1:])


def main() -> None:
    given = parse_arguments()
    files.check_writable(given.png)
    odom, cmd_vel = (os.path.join("/", given.robot, name) for name in ("odom", "cmd_vel"))
    if given.bag:
        recording = read_bag(given.bag, odom, cmd_vel)
        missing = f"{given.bag} holds no nav_msgs/Odometry on {odom}. Another robot's: --robot NAME"
    else:
        require_master()
        recording = record(odom, cmd_vel, given.seconds)
        missing = f"Nothing was published on {odom}. Start the robot: roslaunch simulation simulation.launch"
    if not recording.velocities:
        sys.exit(printable(missing))
    draw(recording, given.png)
    print(printable(f"Drew {given.png}."))


if __name__ == "__main__":
    try:
        main()
    except (OSError, ValueError, rosbag.ROSBagException) as error:
        sys.exit(printable(f"Nothing was drawn: {error}"))
    except KeyboardInterrupt:
        sys.exit(1)
