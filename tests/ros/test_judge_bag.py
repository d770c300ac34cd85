"""judge.py and rosbags: each bag of a folder gets its row, whatever it holds, and nothing in it is executed."""

import bz2
import csv
import math
import os
import runpy
import shutil
import struct
import sys
from pathlib import Path

import pytest
import rosbag
import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

from driving_tasks.bags import judge_bags
from driving_tasks.tasks import TASKS
from jetbot import JetbotError

PROGRAM = Path(__file__).parents[2] / "morbot_ws/src/scenarios/driving_tasks/scripts/judge.py"
TRUTH = "/jetbot_simulator/ground_truth"
ARMED = "int8 open('executed','w');X=1"  # a message's definition; rosbag writes it into a module, which it imports


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """The working folder, empty."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def judge(monkeypatch, capsys):
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


def odometry(time, x, yaw=0.0):
    message = Odometry()
    message.header.stamp = rospy.Time.from_sec(time)
    message.pose.pose.position.x = x
    message.pose.pose.orientation.z, message.pose.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
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


def write_commands(name, topic="/cmd_vel"):
    with rosbag.Bag(name, "w") as bag:
        for number in range(34):
            bag.write(topic, forward(0.5), rospy.Time.from_sec(100 + number / 10))
        bag.write(topic, forward(0.0), rospy.Time.from_sec(103.4))


def table(text):
    return [tuple(row.values()) for row in csv.DictReader(text.splitlines())]


def test_one_bag_gets_sentences_and_a_picture(judge, folder):
    write("drive.bag", length=0.9)
    code, text = judge("metre", "--bag", "drive.bag", "--csv", "marks.csv")
    assert (code, text.splitlines()) == (0, [
        "metre: 36.8 of 100 points in 3.0 s.", "Largest loss: stopped 10 cm short of the goal (63.2 points).",
        "Drew metre.png.", "Wrote marks.csv."])
    assert (folder / "metre.png").read_bytes()[:4] == b"\x89PNG"
    assert table((folder / "marks.csv").read_text("utf-8-sig")) == [
        ("drive.bag", "metre", "36.8", "3.0", "stopped 10 cm short of the goal", "")]


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
        1, "drive.bag: It holds /blue and /red: choose a robot with --robot NAME.\n")
    assert judge("metre", "--bag", "drive.bag", "--robot", "red")[0] == 0


def test_a_folder_gets_a_row_for_each_bag(judge, folder):
    for number in range(30):
        (folder / f"class/{number:02}").mkdir(parents=True)
        write(f"class/{number:02}/drive.bag", length=1 - number / 100)
    code, text = judge("metre", "--bag", "class")
    assert (code, len(table(text))) == (0, 30)
    assert table(text)[5] == ("05/drive.bag", "metre", "60.7", "3.2", "stopped 5 cm short of the goal", "")


def test_a_folder_gets_a_folder_of_pictures(judge, folder):
    for name in ("anna", "ben"):
        (folder / "class" / name).mkdir(parents=True)
        write(f"class/{name}/drive.bag")
    assert judge("metre", "--bag", "class", "--pictures", "pictures")[0] == 0
    assert sorted((folder / "pictures").rglob("*.png")) == [
        folder / "pictures/anna/drive.bag.png", folder / "pictures/ben/drive.bag.png"]


def connection(old, new):
    """Return a function that lets all messages of one connection of a bag belong to another one."""
    before, after = (b"op=\x02\x09\x00\x00\x00conn=" + struct.pack("<L", number) for number in (old, new))
    return lambda content: content.replace(before, after)


def write_armed(name, topic):
    """Write a bag whose second connection has a definition that rosbag executes."""
    write(name)
    header = {"topic": topic, "type": "evil/Odd", "md5sum": "0" * 32, "message_definition": ARMED}
    with rosbag.Bag(name, "a") as bag:
        message = (header["type"], b"", header["md5sum"], Odometry)
        bag.write(topic, message, rospy.Time(100), raw=True, connection_header=header)
    return Path(name)


def test_rosbag_executes_what_an_armed_bag_holds(folder):
    """So that the next test tests something."""
    write_armed("armed.bag", "/odom")
    with rosbag.Bag("armed.bag") as bag:
        list(bag.read_messages())
    assert (folder / "executed").exists()


def edit(file, change):
    file.write_bytes(change(file.read_bytes()))


def write_bomb(name):
    """Write a bag of a few kB that is 2 GB when it is unpacked."""
    with rosbag.Bag(name, "w", compression="bz2") as bag:
        bag.write(TRUTH, odometry(100, 0))
    zeros = bz2.compress(bytes(20_000_000)) * 100
    with rosbag.Bag(name) as bag:
        chunk = next(iter(bag._chunk_headers.values()))
    content = Path(name).read_bytes()
    end = chunk.data_pos + chunk.compressed_size
    grown = len(zeros) - chunk.compressed_size
    content = (content[:chunk.data_pos - 4] + struct.pack("<L", len(zeros)) + zeros + content[end:])
    position = content.index(b"index_pos=") + len(b"index_pos=")
    index = struct.unpack("<Q", content[position:position + 8])[0] + grown
    Path(name).write_bytes(content[:position] + struct.pack("<Q", index) + content[position + 8:])


def encrypted(content):
    """Return a bag that claims to be encrypted, in its first record."""
    start = len("#ROSBAG V2.0\n")
    size, = struct.unpack("<L", content[start:start + 4])
    field = b"encryptor=rosbag/AesCbcEncryptor"
    field = struct.pack("<L", len(field)) + field
    padding = start + 4 + size
    length, = struct.unpack("<L", content[padding:padding + 4])
    return (content[:start] + struct.pack("<L", size + len(field)) + content[start + 4:padding] + field
            + struct.pack("<L", length - len(field)) + content[padding + 4 + len(field):])


def not_a_number(time, x):
    return odometry(time, math.nan)


HOSTILE = {
    "armed.bag": (lambda name: write_armed(name, "/odom"), None),
    "armed_message.bag": (lambda name: edit(write_armed(name, "/x"), connection(0, 1)), "It is damaged: "),
    "bomb.bag": (write_bomb, "It needs more than 1000 MB of memory."),
    "cut.bag": (lambda name: edit(write(name), lambda content: content[:5000]), "Its recording was cut short. "),
    "empty.bag": (lambda name: Path(name).touch(), "It is empty."),
    "encrypted.bag": (lambda name: edit(write(name), encrypted), "It is encrypted: "),
    "fifo.bag": (os.mkfifo, "It is not a regular file."),
    "huge.bag": (lambda name: os.truncate(os.open(name, os.O_CREAT | os.O_WRONLY), 10 ** 12), "It is larger than"),
    "link.bag": (lambda name: os.symlink("/etc/passwd", name), "It is a link: hand in the file itself."),
    "nan.bag": (lambda name: write(name, make=not_a_number), "There is nothing to judge: "),
    "noise.bag": (lambda name: Path(name).write_bytes(b"#ROSBAG V2.0\n" + bytes(range(256)) * 99), "Its recording"),
    "nothing.bag": (lambda name: rosbag.Bag(name, "w").close(), "It holds no drive: "),
    "other_kind.bag": (lambda name: write(name, "/odom", make=lambda time, x: Twist()), "It holds no drive: "),
    "still.bag": (lambda name: write(name, length=0), "The robot did not drive."),
    "text.bag": (lambda name: Path(name).write_text("hello"), "It is not a rosbag."),
    "unfinished.bag.active": (lambda name: rosbag.Bag(name, "w").flush(), "Its recording was cut short. "),
    "wrong_kind.bag": (lambda name: edit(write_armed(name, "/x"), connection(1, 0)), None),
    "=1+1\n\x1b]0;owned\x07.bag": (write, None),
    os.fsdecode(b"\xff.bag"): (write, None),
}


def test_a_hostile_folder_gets_its_rows(judge, folder):
    (folder / "class").mkdir()
    for name, (make, _) in HOSTILE.items():
        make(f"class/{name}")
    code, text = judge("metre", "--bag", "class")
    assert code == 1
    problems = {name: problem for name, *_, problem in table(text)}
    assert len(problems) == len(HOSTILE)
    for name, (_, problem) in HOSTILE.items():
        shown = name.encode("unicode_escape", "backslashreplace").decode()
        shown = f"'{shown}" if name.startswith("=") else shown
        assert problems[shown].startswith(problem) if problem else not problems[shown], (name, problems[shown])
    assert sorted(os.listdir(folder)) == ["class"]  # nothing was executed


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
    (("metre", "--bag", "."), ". holds no file that ends in .bag."),
    (("metre", "--bag", ".", "--picture", "x.png"), "--picture is of one drive: of several, --pictures FOLDER."),
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
    assert (code, text.splitlines()[0].split(None, 1)) == (0, ["metre", "One metre"])
