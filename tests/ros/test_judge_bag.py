"""judge.py and rosbags: the same drive has the same score each time, alone or in a folder."""

import pytest
import rosbag
import rospy
from geometry_msgs.msg import Twist
from std_msgs.msg import String

from driving_tasks.scoring.recorder import MOVED
from driving_tasks.scoring.tasks import TASKS
from driving_tasks.sources.bags import judge_bag, judge_bags
from judged_bags import TRUTH, judge_in_process, odometry, table, working_folder, write  # noqa: F401  fixtures

METRE = TASKS["metre"]


def test_one_bag_gets_sentences_and_a_picture(judge, folder):
    write("drive.bag", length=0.9)
    code, text = judge("metre", "--bag", "drive.bag", "--csv", "marks.csv")
    assert (code, text.splitlines()) == (0, [
        "metre: 36.8 of 100 points in 3.0 s.", "Largest loss: stopped 10 cm short of the goal (63.2 points).",
        "Drawing metre.png ...", "Drew metre.png.", "Wrote marks.csv."])
    assert (folder / "metre.png").read_bytes()[:4] == b"\x89PNG"
    assert table((folder / "marks.csv").read_text("utf-8-sig")) == [
        ("", "drive.bag", "metre", "36.8", "3.0", "stopped 10 cm short of the goal", "", "simulator")]


def test_a_folder_gets_a_row_and_a_picture_for_each_bag_the_same_each_time(judge, folder):
    for name in ("anna", "ben"):
        (folder / "class" / name).mkdir(parents=True)
        write(f"class/{name}/drive.bag", length=0.95)
    code, text = judge("metre", "--bag", "class", "--pictures", "pictures")
    assert (code, table(text)) == (0, [("", f"{name}/drive.bag", "metre", "60.7", "3.2",
                                        "stopped 5 cm short of the goal", "", "simulator") for name in ("anna", "ben")])
    assert sorted((folder / "pictures").rglob("*.png")) == [
        folder / "pictures/anna/drive.bag.png", folder / "pictures/ben/drive.bag.png"]
    assert len({mark.result.score for mark in judge_bags(METRE, "class")}) == 1


@pytest.mark.parametrize("topic, source", [(TRUTH, ""), ("odom", "odometry"), ("/red/odom", "odometry")])
def test_the_drive_is_known_from_the_best_topic(folder, topic, source):
    write("drive.bag", topic)
    with rosbag.Bag("drive.bag", "a") as bag:
        bag.write("/red/cmd_vel" if "red" in topic else "cmd_vel", Twist(), rospy.Time(100))
    mark = judge_bag(METRE, "drive.bag")
    assert mark.result.score > 99.9 and mark.source == source


def test_a_drive_in_which_something_else_than_the_wheels_moved_the_robot_is_refused(folder):
    write("drive.bag", make=lambda time, x, _: odometry(time, x, 0.0))
    assert judge_bag(METRE, "drive.bag").problem == MOVED


def test_a_changed_simulator_is_named(folder):
    write("drive.bag")
    with rosbag.Bag("drive.bag", "a") as bag:
        bag.write("jetbot_simulator/body", String("max_speed 3 for 0.6\x1b" + "!" * 999), rospy.Time(100))
    source = judge_bag(METRE, "drive.bag").source
    assert source.startswith("simulator with max_speed 3 for 0.6\\x1b!") and len(source) < 200


def test_several_robots_in_a_bag(judge):
    write("drive.bag", f"/red{TRUTH}")
    with rosbag.Bag("drive.bag", "a") as bag:
        bag.write("/blue/odom", odometry(100, 0))
    assert judge("metre", "--bag", "drive.bag") == (
        1, "drive.bag: It holds blue and red: choose one with --robot NAME.\n")
    assert judge("metre", "--bag", "drive.bag", "--robot", "red")[0] == 0


def test_a_picture_is_not_drawn_through_a_link(judge, folder):
    write("drive.bag")
    (folder / "precious").write_text("keep me")
    (folder / "metre.png").symlink_to("precious")
    assert "No picture was drawn: metre.png is a link" in judge("metre", "--bag", "drive.bag")[1]
    assert (folder / "precious").read_text() == "keep me"


def test_what_cannot_be_read_or_written_is_one_sentence(judge):
    assert judge("metre", "--bag", ".")[0].startswith("There is no file that ends in .bag in .")
    assert judge("metre", "--bag", "x", "--csv", "no/marks.csv")[0].startswith("[Errno 2] No such file or directory")
