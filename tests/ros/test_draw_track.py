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
    def run(bag, robot="red", png="track.png"):
        monkeypatch.setattr(sys, "argv", ["", "--bag", bag.filename, "--robot", robot, str(tmp_path / png)])
        try:
            runpy.run_path(str(PROGRAM), run_name="__main__")
        except SystemExit as end:
            return end.code
    return run


@pytest.mark.parametrize("name", ["track.png", "track"])
def test_draws_a_bag_into_the_file_of_this_name(draw, bag, tmp_path, name):
    bag.close()
    assert draw(bag, png=name) is None
    assert (tmp_path / name).read_bytes()[:4] == b"\x89PNG"
    assert sorted(os.listdir(tmp_path)) == ["drive.bag", name]


@pytest.mark.parametrize("robot, odom", [("", "/odom"), ("green", "/green/odom")])
def test_no_odometry_of_this_robot(draw, bag, robot, odom):
    bag.write("odom", Twist())
    bag.close()
    assert draw(bag, robot) == f"{bag.filename} holds no nav_msgs/Odometry on {odom}. Another robot's: --robot NAME"


@pytest.mark.parametrize("topics, sentence", [
    ({}, "Nothing is published on /odom. Start a simulated robot: roslaunch simulation simulation.launch"),
    ({"/red/odom": Odometry._type, "/blue/odom": "std_msgs/String"},
     "Nothing is published on /odom. Choose another robot: --robot red"),
    ({"/odom": Odometry._type}, "Nothing arrives on /odom. Is the program that publishes it frozen (Ctrl-Z)? "
                                "Continue it with fg.")])
def test_why_no_odometry_arrives(monkeypatch, topics, sentence):
    advice = runpy.run_path(str(PROGRAM))["advice"]
    monkeypatch.setitem(advice.__globals__, "ask_master", lambda method, subgraph: list(map(list, topics.items())))
    assert advice("/odom") == sentence


def test_a_robot_of_an_impossible_name(draw, bag, capsys):
    bag.close()
    assert draw(bag, "\x1b]0;owned\x07") == 2
    assert "argument --robot: invalid robot value" in capsys.readouterr().err


def test_recording_cut_short(draw, bag):
    bag.flush()
    assert draw(bag) == (
        f"Nothing was drawn: the recording of {bag.filename} was cut short. Fix it: rosbag reindex {bag.filename}")


@pytest.fixture(params=["fifo", "folder", "text", "sparse", "damaged"])
def odd(request, bag, tmp_path):
    """What is not a bag, in the place of one."""
    bag.close()
    file = Path(bag.filename)
    content = file.read_bytes()
    file.unlink()
    {"fifo": lambda: os.mkfifo(file), "folder": file.mkdir, "text": lambda: file.write_text("\x1b[2J"),
     "sparse": lambda: file.touch() or os.truncate(file, 50 * 10**9),
     "damaged": lambda: file.write_bytes(content.replace(b"conn=\0\0\0\0\r", b"conn=\0\0\0\7\r"))}[request.param]()
    return bag


def test_what_is_not_a_bag_gets_one_sentence(draw, odd, tmp_path):
    message = draw(odd)
    assert message.startswith("Nothing was drawn: ") and message.isprintable()
    assert os.listdir(tmp_path) == ["drive.bag"]


@pytest.mark.parametrize("make", [os.mkdir, os.mkfifo, lambda file: os.symlink("/dev/full", file)])
def test_only_a_file_is_drawn_into(draw, bag, tmp_path, make):
    bag.close()
    make(tmp_path / "track.png")
    assert draw(bag).startswith("Nothing was drawn: ")
    assert sorted(os.listdir(tmp_path)) == ["drive.bag", "track.png"]


@pytest.mark.parametrize("seconds", ["inf", "nan", "-1", "0", "1e400", "long"])
def test_how_long_to_record(monkeypatch, capsys, seconds):
    monkeypatch.setattr(sys, "argv", ["", "--seconds", seconds])
    with pytest.raises(SystemExit):
        runpy.run_path(str(PROGRAM), run_name="__main__")
    assert f"argument --seconds: invalid duration value: '{seconds}'" in capsys.readouterr().err
