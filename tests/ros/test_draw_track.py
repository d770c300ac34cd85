"""One sentence from draw_track.py for each bag from which it cannot draw."""

import runpy
import sys
from pathlib import Path

import pytest
import rosbag
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

PROGRAM = Path(__file__).parents[2] / "morbot_ws/src/simulation/scripts/draw_track.py"


@pytest.fixture
def bag(tmp_path):
    """A bag, open for writing."""
    with rosbag.Bag(str(tmp_path / "drive.bag"), "w") as bag:
        yield bag


def error_of(monkeypatch, bag):
    """Return the message with which the program exits."""
    monkeypatch.setattr(sys, "argv", ["draw_track.py", "--bag", bag.filename])
    with pytest.raises(SystemExit) as end:
        runpy.run_path(str(PROGRAM), run_name="__main__")
    return end.value.code


@pytest.mark.parametrize("topic, message", [("odom", Twist()), ("/red/odom", Odometry())])
def test_no_odometry_of_this_robot(monkeypatch, bag, topic, message):
    bag.write(topic, message)
    bag.close()
    assert error_of(monkeypatch, bag) == (
        f"{bag.filename} holds no nav_msgs/Odometry on /odom. Another robot's: --robot NAME")


def test_recording_cut_short(monkeypatch, bag):
    bag.write("odom", Odometry())
    bag.flush()
    assert error_of(monkeypatch, bag) == (
        f"Nothing was drawn: the recording of {bag.filename} was cut short. Fix it: rosbag reindex {bag.filename}")


def test_no_bag(monkeypatch, bag, tmp_path):
    bag.close()
    Path(bag.filename).write_text("hello")
    assert error_of(monkeypatch, bag).startswith("Nothing was drawn: ")
