"""A folder that somebody handed in: each bag gets its row, whatever it holds, and nothing in it is executed."""

import bz2
import math
import os
import struct
from pathlib import Path

import rosbag
import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

from judged_bags import TRUTH, judge_in_process, odometry, table, working_folder, write  # noqa: F401  fixtures

ARMED = "int8 open('executed','w');X=1"  # a message's definition; rosbag writes it into a module, which it imports


def test_rosbag_executes_what_an_armed_bag_holds(folder):
    """So that the next test tests something."""
    write_armed("armed.bag", "/odom")
    with rosbag.Bag("armed.bag") as bag:
        list(bag.read_messages())
    assert (folder / "executed").exists()


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
    problems = {name: problem for name, *_, problem, _ in table(text)}
    assert len(problems) == len(HOSTILE)
    for name, (_, problem) in HOSTILE.items():
        shown = name.encode("unicode_escape", "backslashreplace").decode()
        shown = f"'{shown}" if name.startswith("=") else shown
        assert problems[shown].startswith(problem) if problem else not problems[shown], (name, problems[shown])
    assert sorted(os.listdir(folder)) == ["class"]  # nothing was executed
