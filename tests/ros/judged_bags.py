"""Rosbags of drives, and judge.py, which judges them in this process."""

import csv
import runpy
import sys
from pathlib import Path

import pytest
import rosbag
import rospy
from nav_msgs.msg import Odometry

from jetbot import JetbotError

PROGRAM = Path(__file__).parents[2] / "morbot_ws/src/driving_tasks/scripts/judge.py"
TRUTH = "/jetbot_simulator/ground_truth"


@pytest.fixture(name="folder")
def working_folder(tmp_path, monkeypatch):
    """The working folder, empty."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(name="judge")
def judge_in_process(folder, monkeypatch, capsys):
    """Runs judge.py with these arguments; returns its exit code, or its message, and what it printed."""
    def run(*arguments):
        monkeypatch.setattr(sys, "argv", ["judge.py", *map(str, arguments)])
        capsys.readouterr()
        try:
            code = runpy.run_path(str(PROGRAM))["main"]()
        except (SystemExit, OSError, JetbotError) as end:
            code = str(end)
        return code, capsys.readouterr().out
    return run


def odometry(time, x, speed=0.3):
    message = Odometry()
    message.header.stamp = rospy.Time.from_sec(time)
    message.pose.pose.position.x = x
    message.pose.pose.orientation.w = 1.0
    message.twist.twist.linear.x = speed
    return message


def positions(length):
    """The times in s, x in m and speeds in m/s of a drive at 0.3 m/s."""
    for number in range(500):
        x = (number - 50) * 0.006
        yield 100 + number / 50, min(length, max(0.0, x)), 0.3 if 0 <= x < length else 0.0


def write(name, topic=TRUTH, length=1.0, make=odometry):
    """Write a bag of a drive of this length in m."""
    with rosbag.Bag(name, "w") as bag:
        for time, *motion in positions(length):
            bag.write(topic, make(time, *motion), rospy.Time.from_sec(time))
    return Path(name)


def table(text):
    """Return the rows of a table, without its header."""
    return [tuple(row.values()) for row in csv.DictReader(text.splitlines())]
