"""What draw_track.py says of bags from which it cannot draw."""

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
    """A bag to write into."""
    with rosbag.Bag(str(tmp_path / "drive.bag"), "w") as bag:
        yield bag


def said(monkeypatch, bag):
    """What the program says of the bag as it ends."""
    monkeypatch.setattr(sys, "argv", ["draw_track.py", "--bag", bag.filename])
    with pytest.raises(SystemExit) as end:
        runpy.run_path(str(PROGRAM), run_name="__main__")
    return end.value.code


@pytest.mark.parametrize("topic, message", [("odom", Twist()), ("/red/odom", Odometry())])
def test_no_odometry_of_this_robot(monkeypatch, bag, topic, message):
    bag.write(topic, message)
    bag.close()
    assert said(monkeypatch, bag) == (
        f"{bag.filename} holds no nav_msgs/Odometry on /odom. Another robot's: --robot NAME")


def test_recording_cut_short(monkeypatch, bag):
    bag.write("odom", Odometry())
    bag.flush()
    assert said(monkeypatch, bag) == (
        f"Nothing was drawn: the recording of {bag.filename} was cut short. Mend it: rosbag reindex {bag.filename}")


def test_no_bag(monkeypatch, bag, tmp_path):
    bag.close()
    Path(bag.filename).write_text("hello")
    assert said(monkeypatch, bag).startswith("Nothing was drawn: ")
