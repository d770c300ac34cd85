"""judge.py and rosbags: the same drive has the same score each time, alone or in a folder."""

import os
import shutil

import pytest
import rosbag
import rospy
from geometry_msgs.msg import Twist

from driving_tasks.scoring.tasks import TASKS
from driving_tasks.sources.bags import judge_bags
from judged_bags import TRUTH, judge_in_process, odometry, table, working_folder, write, write_commands  # noqa: F401  fixtures


def test_one_bag_gets_sentences_and_a_picture(judge, folder):
    write("drive.bag", length=0.9)
    code, text = judge("metre", "--bag", "drive.bag", "--csv", "marks.csv")
    assert (code, text.splitlines()) == (0, [
        "metre: 36.8 of 100 points in 3.0 s.", "Largest loss: stopped 10 cm short of the goal (63.2 points).",
        "Drew metre.png.", "Wrote marks.csv."])
    assert (folder / "metre.png").read_bytes()[:4] == b"\x89PNG"
    assert table((folder / "marks.csv").read_text("utf-8-sig")) == [
        ("drive.bag", "metre", "36.8", "3.0", "stopped 10 cm short of the goal", "", "simulator")]


def test_the_same_bag_has_the_same_score_each_time(judge, folder):
    write("drive.bag", length=0.9737)
    (folder / "copies").mkdir()
    for number in range(10):
        shutil.copy("drive.bag", f"copies/{number}.bag")
    first, second = (judge("metre", "--bag", "copies", "--csv", name)[1] for name in ("a.csv", "b.csv"))
    assert first.replace("a.csv", "b.csv") == second
    assert len({row[1:] for row in table(first) if row[1]}) == 1
    assert (folder / "a.csv").read_bytes() == (folder / "b.csv").read_bytes()


@pytest.mark.parametrize("topic, source", [(TRUTH, None), ("odom", "odometry"), ("/red/odom", "odometry")])
def test_the_drive_is_known_from_the_best_topic(judge, topic, source):
    write("drive.bag", topic)
    with rosbag.Bag("drive.bag", "a") as bag:
        bag.write("/red/cmd_vel" if "red" in topic else "cmd_vel", Twist(), rospy.Time(100))
    code, text = judge("metre", "--bag", "drive.bag")
    assert code == 0
    assert text.startswith("metre: 100.0 of 100 points in 3.3 s.\n")
    assert (f"Measured by its {source}, not by the simulator." in text) == bool(source)


def test_commands_alone_are_driven_in_a_simulation(judge):
    write_commands("drive.bag")
    code, text = judge("metre", "--bag", "drive.bag")
    assert (code, "Measured by its commands, not by the simulator." in text) == (0, True)
    assert judge("metre", "--bag", "drive.bag", "--config", "si_units.yaml")[1] != text
    assert judge("metre", "--bag", "drive.bag", "--config", "nothing.yaml")[0].startswith("There is no file nothing.")


def test_several_robots_in_a_bag(judge):
    write("drive.bag", f"/red{TRUTH}")
    with rosbag.Bag("drive.bag", "a") as bag:
        bag.write("/blue/odom", odometry(100, 0))
    assert judge("metre", "--bag", "drive.bag") == (
        1, "drive.bag: It holds blue and red: choose one with --robot NAME.\n")
    assert judge("metre", "--bag", "drive.bag", "--robot", "red")[0] == 0


def test_a_folder_gets_a_row_for_each_bag(judge, folder):
    for number in range(30):
        (folder / f"class/{number:02}").mkdir(parents=True)
        write(f"class/{number:02}/drive.bag", length=1 - number / 100)
    code, text = judge("metre", "--bag", "class")
    assert (code, len(table(text))) == (0, 30)
    assert table(text)[5] == ("05/drive.bag", "metre", "60.7", "3.2", "stopped 5 cm short of the goal", "", "simulator")


def test_a_folder_gets_a_folder_of_pictures(judge, folder):
    for name in ("anna", "ben"):
        (folder / "class" / name).mkdir(parents=True)
        write(f"class/{name}/drive.bag")
    assert judge("metre", "--bag", "class", "--pictures", "pictures")[0] == 0
    assert sorted((folder / "pictures").rglob("*.png")) == [
        folder / "pictures/anna/drive.bag.png", folder / "pictures/ben/drive.bag.png"]


def test_a_bag_that_vanishes_meanwhile(folder):
    for number in range(4):
        write(f"{number}.bag")
    marks = judge_bags(TASKS["metre"], ".")
    assert next(marks).result
    os.remove("3.bag")
    assert [mark.problem for mark in marks] == ["", "", "It cannot be read: No such file or directory."]


def test_links_in_a_folder_lead_to_no_file(judge, folder):
    write("drive.bag")
    (folder / "precious").write_text("keep me")
    (folder / "metre.png").symlink_to("precious")
    assert "No picture was drawn: metre.png is a link" in judge("metre", "--bag", "drive.bag")[1]
    assert (folder / "precious").read_text() == "keep me"


@pytest.mark.parametrize("arguments, sentence", [
    (("meter",), "There is no task meter. Did you mean metre?"),
    (("xyz",), "There is no task xyz. The tasks are metre, quarter, square, circle, s_bend, smooth, park and follow."),
    (("metre", "--bags", "x"), "Unrecognized arguments: --bags x. See judge.py --help."),
    (("metre", "--robot", "a b"), "A robot's name is a name of ROS, not a b."),
    (("metre", "--bag", "."), "There is no file that ends in .bag in .."),
    (("metre", "--bag", ".", "--picture", "x.png"), "--picture is for one drive; for several, use --pictures FOLDER."),
    (("metre", "--bag", "x", "--record", "y.bag"), "--record is for a robot that drives now."),
    (("--bag", "drive.bag"), "The task is missing. The tasks are metre, "),
    (("metre", "--bag", ""), "--bag: The name of a file is missing."),
    (("metre", "--bag", "x.bag", "--picture", "x.bag"), "--picture: Its name must end in .png, not x.bag."),
    (("metre", "--bag", "x.bag", "--csv", "x.bag"), "--csv: Its name must end in .csv, not x.bag."),
    (("metre", "--bag", "x", "--csv", "no/marks.csv"), "[Errno 2] No such file or directory"),
], ids=lambda value: " ".join(value) if isinstance(value, tuple) else "")
def test_what_cannot_be_meant_is_one_sentence(judge, arguments, sentence):
    assert judge(*arguments)[0].startswith(sentence)


def test_without_a_task_the_tasks_are_listed(judge):
    code, text = judge()
    assert (code, text.splitlines()[0].split(None, 1)) == (0, ["metre", "1 m straight ahead"])
