"""A folder that somebody handed in: each bag gets its row, whatever it holds, and nothing in it is executed."""

import bz2
import os
import struct
from pathlib import Path

import rosbag
import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

from driving_tasks.scoring.tasks import TASKS
from driving_tasks.sources.bags import judge_bags
from judged_bags import TRUTH, odometry, working_folder, write  # noqa: F401  fixtures

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


HOSTILE = {
    "armed.bag": (lambda name: write_armed(name, "/odom"), ""),
    "armed_message.bag": (lambda name: edit(write_armed(name, "/x"), connection(0, 1)), "It is damaged: "),
    "bomb.bag": (write_bomb, "It needs more than 1000 MB of memory."),
    "cut.bag": (lambda name: edit(write(name), lambda content: content[:5000]), "Its recording was cut short. "),
    "encrypted.bag": (lambda name: edit(write(name), encrypted), "It is encrypted: "),
    "noise.bag": (lambda name: Path(name).write_bytes(b"#ROSBAG V2.0\n" + bytes(range(256)) * 99), "Its recording"),
    "other_kind.bag": (lambda name: write(name, "/odom", make=lambda *_: Twist()), "It does not hold "),
    "wrong_kind.bag": (lambda name: edit(write_armed(name, "/x"), connection(1, 0)), ""),
    os.fsdecode(b"\xff.bag"): (write, ""),
}


def test_a_hostile_folder_gets_its_rows(folder):
    (folder / "class").mkdir()
    for name, (make, _) in HOSTILE.items():
        make(f"class/{name}")
    marks = {mark.name: mark for mark in judge_bags(TASKS["metre"], "class")}
    assert set(marks) == set(HOSTILE)
    for name, (_, problem) in HOSTILE.items():
        assert marks[name].problem.startswith(problem) and bool(marks[name].result) != bool(problem), marks[name]
    assert sorted(os.listdir(folder)) == ["class"]  # nothing was executed
