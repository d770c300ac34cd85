#!/usr/bin/env python3
"""Draws where a robot drove, and how fast, into a PNG file."""

import argparse
import signal
import sys

import rosbag
import rospy

from jetbot import files
from jetbot.text import printable
from jetbot_ros.master import require_master
from simulation.recording import read_bag, record


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("png", nargs="?", default="track.png")
    source = parser.add_mutually_exclusive_group()
    source.add_argument("--bag", help="a rosbag with odom and cmd_vel")
    source.add_argument("--seconds", type=float, default=20,
                        help="how long to record the robot that drives now (default: 20)")
    parser.add_argument("--robot", default="", help="the robot's namespace")
    return parser.parse_args(rospy.myargv()[1:])


def main() -> None:
    given = parse_arguments()
    files.check_writable(given.png)
    odom, cmd_vel = (f"/{given.robot}/{name}".replace("//", "/") for name in ("odom", "cmd_vel"))
    if given.bag:
        recording, missing = read_bag(given.bag, odom, cmd_vel), f"{given.bag} holds no nav_msgs/Odometry on {odom}."
    else:
        require_master()
        print(f"Recording {odom} for {given.seconds:g} s; Ctrl-C ends earlier and draws what there is.", flush=True)
        recording = record(odom, cmd_vel, given.seconds)
        missing = f"Nothing arrives on {odom}. Start a simulated robot: roslaunch simulation simulation.launch."
    if not recording.velocities:
        sys.exit(printable(f"{missing} Another robot's: --robot NAME"))
    print(printable(f"Drawing {given.png} ..."), flush=True)
    from simulation.drawing import draw  # here: it takes longer to import than all the rest
    draw(recording, given.png)
    print(printable(f"Drew {given.png}."))


if __name__ == "__main__":
    try:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        main()
    except (OSError, ValueError, rosbag.ROSBagException) as error:
        sys.exit(printable(f"Nothing was drawn: {error}"))
    except KeyboardInterrupt:
        sys.exit(130)  # as shells have it
