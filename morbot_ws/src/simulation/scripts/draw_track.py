#!/usr/bin/env python3
"""Draws where a robot drove, and how fast, into a PNG file."""

import signal
import sys

if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # while it imports, Ctrl-C prints no traceback

try:
    import argparse
    import os

    import rosbag
    import rosgraph
    import rospy
    from nav_msgs.msg import Odometry

    from jetbot import files
    from jetbot.text import printable
    from jetbot_ros.master import NO_ANSWER, ask_master, master_uri, require_master
    from simulation.recording import Recording, read_bag, record
except ImportError as error:
    sys.exit(f"{error}: open a shell with ./morbot shell, and type rosrun simulation draw_track.py there.")

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


def advice(odom: str) -> str:
    """Return why no odometry arrives on this topic, and what to do."""
    try:
        topics = dict(ask_master("getPublishedTopics", ""))
    except NO_ANSWER:
        return f"The ROS master at {master_uri()} does not answer. Is it frozen (Ctrl-Z)? Continue it with fg."
    if odom in topics:
        return f"Nothing arrives on {odom}. Is the program that publishes it frozen (Ctrl-Z)? Continue it with fg."
    others = sorted(topic[1:-len("/odom")] for topic, kind in topics.items()
                    if kind == Odometry._type and topic.endswith("/odom"))
    if any(others):
        return f"Nothing is published on {odom}. Choose another robot: --robot {others[-1]}"
    return f"Nothing is published on {odom}. Start a simulated robot: roslaunch simulation simulation.launch"


def record_robot(odom: str, cmd_vel: str, seconds: float) -> Recording:
    """Record the robot that drives now, and report what it waits for; end the program without a master."""
    require_master()
    print(f"Recording {odom} for {seconds:g} s; Ctrl-C ends earlier and draws what there is.", flush=True)
    return record(odom, cmd_vel, seconds, lambda: print(printable(advice(odom)), flush=True))


def main() -> None:
    given = parse_arguments()
    files.check_writable(given.png)
    odom, cmd_vel = (os.path.join("/", given.robot, name) for name in ("odom", "cmd_vel"))
    if given.bag:
        recording = read_bag(given.bag, odom, cmd_vel)
    else:
        recording = record_robot(odom, cmd_vel, given.seconds)
    if not recording.velocities:
        sys.exit(printable(f"{given.bag} holds no nav_msgs/Odometry on {odom}. Another robot's: --robot NAME"
                           if given.bag else advice(odom)))
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
