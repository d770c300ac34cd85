"""draw_track.py draws from a bag; if it cannot, it ends with one sentence."""

import os
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
    """A bag with odometry of the robot red."""
    with rosbag.Bag(str(tmp_path / "drive.bag"), "w") as bag:
        bag.write("red/odom", Odometry())
        bag.write("/red/cmd_vel", Twist())
        yield bag


@pytest.fixture
def draw(monkeypatch, tmp_path):
    """Draws track.png from a bag; returns the message with which the program exits, or None."""
    def run(bag, robot="red"):
        monkeypatch.setattr(sys, "argv", ["", "--bag", bag.filename, "--robot", robot, str(tmp_path / "track.png")])
        try:
            runpy.run_path(str(PROGRAM), run_name="__main__")
        except SystemExit as end:
            return end.code
    return run


def test_draws_a_bag_into_the_file_of_this_name(draw, bag, tmp_path, capsys):
    bag.close()
    assert draw(bag) is None
    assert capsys.readouterr().out == "Drawing {0} ...\nDrew {0}.\n".format(tmp_path / "track.png")
    assert (tmp_path / "track.png").read_bytes()[:4] == b"\x89PNG"
    assert sorted(os.listdir(tmp_path)) == ["drive.bag", "track.png"]


@pytest.mark.parametrize("robot, odom", [("", "/odom"), ("green", "/green/odom")])
def test_no_odometry_of_this_robot(draw, bag, robot, odom):
    bag.write("odom", Twist())
    bag.close()
    assert draw(bag, robot) == f"{bag.filename} holds no nav_msgs/Odometry on {odom}. Another robot's: --robot NAME"


def test_recording_cut_short(draw, bag):
    bag.flush()
    assert draw(bag) == (
        f"Nothing was drawn: the recording of {bag.filename} was cut short. Fix it: rosbag reindex {bag.filename}")


@pytest.mark.parametrize("make", [os.mkfifo, lambda file: file.write_text("\x1b[2J"),
                                  lambda file: file.write_bytes(b"#ROSBAG V2.0\n" + b"\7" * 5000)])
def test_what_is_not_a_bag_gets_one_sentence(draw, bag, tmp_path, make):
    bag.close()
    os.unlink(bag.filename)
    make(Path(bag.filename))
    message = draw(bag)
    assert message.startswith("Nothing was drawn: ") and message.isprintable()
    assert os.listdir(tmp_path) == ["drive.bag"]


def test_only_a_file_is_drawn_into(draw, bag, tmp_path):
    bag.close()
    os.mkfifo(tmp_path / "track.png")
    assert draw(bag).startswith("Nothing was drawn: ")
    assert sorted(os.listdir(tmp_path)) == ["drive.bag", "track.png"]
