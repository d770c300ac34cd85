"""Rosbags of drives, and judge.py, which judges them in this process."""

import csv
import runpy
import sys
from pathlib import Path

import pytest
import rosbag
import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

from jetbot import JetbotError

PROGRAM = Path(__file__).parents[2] / "morbot_ws/src/scenarios/driving_tasks/scripts/judge.py"
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


def odometry(time, x):
    message = Odometry()
    message.header.stamp = rospy.Time.from_sec(time)
    message.pose.pose.position.x = x
    message.pose.pose.orientation.w = 1.0
    message.twist.twist.linear.x = 0.3
    return message


def forward(speed):
    command = Twist()
    command.linear.x = speed
    return command


def positions(length):
    """The times in s, and x in m, of a drive at 0.3 m/s."""
    for number in range(500):
        yield 100 + number / 50, min(length, max(0.0, number - 50) * 0.006)


def write(name, topic=TRUTH, length=1.0, make=odometry):
    with rosbag.Bag(name, "w") as bag:
        for time, x in positions(length):
            bag.write(topic, make(time, x), rospy.Time.from_sec(time))
    return Path(name)


def table(text):
    """Return the rows of a table, without its header."""
    return [tuple(row.values()) for row in csv.DictReader(text.splitlines())]
