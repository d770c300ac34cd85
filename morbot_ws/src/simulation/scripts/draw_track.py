#!/usr/bin/env python3
"""Draws where a robot drove, from above, and how fast, over time. It listens to a robot, or reads a rosbag:

    rosrun simulation draw_track.py --seconds 20 track.png
    rosrun simulation draw_track.py --bag drive.bag track.png
"""

import argparse
import math
import sys
from typing import NamedTuple

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
import rosbag  # noqa: E402
import rosgraph  # noqa: E402
import rospy  # noqa: E402
from geometry_msgs.msg import Twist  # noqa: E402
from nav_msgs.msg import Odometry  # noqa: E402

from jetbot_ros.master import require_master  # noqa: E402

ACTUAL, COMMANDED, START, END = "tab:blue", "tab:orange", "tab:green", "tab:red"


class Sample(NamedTuple):
    """Where the robot was at a time in seconds, in metres and radians, and how fast, in m/s and rad/s."""

    time: float
    x: float
    y: float
    yaw: float
    linear: float
    angular: float


class Command(NamedTuple):
    """The m/s and rad/s that were asked for at a time in seconds."""

    time: float
    linear: float
    angular: float


class Recording:
    """What a robot was told and did."""

    def __init__(self):
        self.samples = []
        self.commands = []

    def add_odometry(self, odometry):
        pose, twist = odometry.pose.pose, odometry.twist.twist
        yaw = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
        self.samples.append(Sample(odometry.header.stamp.to_sec(), pose.position.x, pose.position.y, yaw,
                                   twist.linear.x, twist.angular.z))

    def add_command(self, time, twist):
        self.commands.append(Command(time, twist.linear.x, twist.angular.z))


def read_bag(file, odom, cmd_vel):
    """The recording in a rosbag."""
    recording = Recording()
    with open_bag(file) as bag:
        for topic, message, time in bag.read_messages():
            name = "/" + topic.lstrip("/")  # rosbag keeps names as they were typed
            if (name, message._type) == (odom, Odometry._type):
                recording.add_odometry(message)
            elif (name, message._type) == (cmd_vel, Twist._type):
                recording.add_command(time.to_sec(), message)
    return recording


def open_bag(file):
    """The rosbag, to be read; ROSBagException with a remedy where its recorder was killed."""
    try:
        return rosbag.Bag(file)
    except rosbag.ROSBagUnindexedException:
        raise rosbag.ROSBagException(f"the recording of {file} was cut short. Mend it: rosbag reindex {file}") from None


def listen(seconds, odom, cmd_vel):
    """A recording of the robot that drives now; Ctrl-C ends it early."""
    require_master()
    recording = Recording()
    rospy.init_node("draw_track", anonymous=True)
    subscribers = [rospy.Subscriber(odom, Odometry, recording.add_odometry),
                   rospy.Subscriber(cmd_vel, Twist, lambda twist: recording.add_command(rospy.get_time(), twist))]
    end = rospy.get_time() + seconds
    while rospy.get_time() < end and not rospy.is_shutdown():
        rospy.rostime.wallsleep(0.1)
    for subscriber in subscribers:
        subscriber.unregister()
    return recording


def draw(recording, file):
    """Draw the recording into a PNG file."""
    figure, (track, linear, angular) = plt.subplots(3, figsize=(7, 9), constrained_layout=True,
                                                      gridspec_kw={"height_ratios": (5, 1.2, 1.2)})
    draw_track(track, recording.samples)
    draw_speed(linear, recording, "linear", "speed (m/s)")
    draw_speed(angular, recording, "angular", "turn (rad/s)")
    linear.sharex(angular)
    linear.tick_params(labelbottom=False)
    linear.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncol=2, frameon=False)
    angular.set_xlabel("time (s)")
    figure.align_ylabels()
    figure.savefig(file, dpi=100)


def draw_track(axes, samples):
    """The way from above, with start, end, and arrows the way that the robot heads."""
    axes.plot([sample.x for sample in samples], [sample.y for sample in samples], color=ACTUAL, linewidth=2)
    for sample in samples[::max(1, len(samples) // 8)]:
        draw_heading(axes, sample, ACTUAL)
    draw_heading(axes, samples[0], START, "start")
    draw_heading(axes, samples[-1], END, "end")
    axes.set_aspect("equal", "datalim")
    axes.margins(0.1)
    axes.set(xlabel="x (m)", ylabel="y (m)", title="The track from above")
    axes.grid(alpha=0.3)


def draw_heading(axes, sample, color, label=None):
    axes.quiver(sample.x, sample.y, math.cos(sample.yaw), math.sin(sample.yaw), color=color, zorder=3,
                pivot="mid", scale=22 if label else 40, width=0.011 if label else 0.006, headlength=4, headaxislength=4)
    if label:
        axes.plot([], [], marker=(3, 0, -90), markersize=11, linestyle="", color=color,
                  label=f"{label}: x {sample.x:.2f} m, y {sample.y:.2f} m, heading {math.degrees(sample.yaw):.0f}°")
        axes.legend(loc="upper left")


def draw_speed(axes, recording, name, label):
    """One of a Sample's speeds as commanded and as driven, in seconds since the first sample."""
    start, end = recording.samples[0].time, recording.samples[-1].time
    commands = [command for command in recording.commands if start <= command.time <= end]
    if commands:
        axes.step([command.time - start for command in commands], [getattr(command, name) for command in commands],
                  where="post", color=COMMANDED, linewidth=4, alpha=0.6, label="commanded")
    axes.plot([sample.time - start for sample in recording.samples],
              [getattr(sample, name) for sample in recording.samples], color=ACTUAL, linewidth=1.5, label="actual")
    axes.set_ylabel(label)
    axes.margins(x=0.01, y=0.15)
    axes.grid(alpha=0.3)


def arguments():
    parser = argparse.ArgumentParser(description="Draw where a robot drove, and how fast, into a PNG file.")
    parser.add_argument("png", nargs="?", default="track.png")
    source = parser.add_mutually_exclusive_group()
    source.add_argument("--bag", help="a rosbag with odom and cmd_vel")
    source.add_argument("--seconds", type=float, default=20, help="how long to listen to the robot that drives now")
    parser.add_argument("--robot", default="", help="the robot's namespace")
    return parser.parse_args(rospy.myargv()[1:])


def main():
    given = arguments()
    topics = [rosgraph.names.ns_join("/" + given.robot.strip("/"), name) for name in ("odom", "cmd_vel")]
    recording = read_bag(given.bag, *topics) if given.bag else listen(given.seconds, *topics)
    if given.bag and not recording.samples:
        sys.exit(f"{given.bag} holds no {Odometry._type} on {topics[0]}. Another robot's: --robot NAME")
    if not recording.samples:
        sys.exit(f"Nothing was published on {topics[0]}. Start the robot: roslaunch simulation simulation.launch")
    draw(recording, given.png)
    print(f"Drew {given.png}.")


if __name__ == "__main__":
    try:
        main()
    except (OSError, ValueError, rosbag.ROSBagException) as error:
        sys.exit(f"Nothing was drawn: {error}")
    except KeyboardInterrupt:
        sys.exit(1)
