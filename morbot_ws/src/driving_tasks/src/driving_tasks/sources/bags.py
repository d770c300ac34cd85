"""Judges the drives in rosbags. A bag is data: nothing that it holds is executed."""

import os
import re
from pathlib import Path
from typing import Dict, Iterator, List, Optional, Tuple

import genpy.dynamic
import rosbag
from nav_msgs.msg import Odometry
from std_msgs.msg import String

from jetbot import files
from jetbot.text import enumeration, printable
from jetbot_ros.contract import BODY, GROUND_TRUTH
from jetbot_ros.ros_messages import pose_of

from .. import contained
from ..report.marks import Mark, changed
from ..scoring.recorder import MOVED, UNEXPLAINED, NoDrive, Sample
from ..scoring.score import Result, judge
from ..scoring.tasks import Task
from .folders import find_files

MAX_SIZE = 200  # MB
MAGIC = b"#ROSBAG V2.0\n"  # http://wiki.ros.org/Bags/Format/2.0
SUFFIXES = (".bag", ".bag.active")  # rosbag renames the second to the first when it ends
ODOM = "odom"
TYPES = {GROUND_TRUTH: Odometry, ODOM: Odometry, BODY: String}
TOPIC = re.compile(rf"/?(?:(.+)/)?({'|'.join(TYPES)})")
Tracks = Dict[Tuple[str, str], List]  # by robot and topic: samples, or texts


def judge_bags(task: Task, path: str, robot: Optional[str] = None) -> Iterator[Mark]:
    """Yield the mark of a bag, or of each bag in a folder. Raises InvalidValue.

    robot: its namespace, None for the only one in a bag.
    """
    for file in find_files(Path(path), *SUFFIXES):
        outcome = (contained.Outcome(problem=file.problem) if file.problem else
                   contained.run(_judge, task, str(file.path), robot))
        result, source = outcome.value or (None, "")
        yield Mark(file.name, task.name, result, outcome.problem, source)


def judge_bag(task: Task, file: str) -> Mark:
    """Return the mark of one bag."""
    return next(judge_bags(task, file))


def sample_of(message: Odometry) -> Sample:
    """Return where and how fast the robot of this message is."""
    twist = message.twist.twist
    return Sample(message.header.stamp.to_sec(), pose_of(message), twist.linear.x, twist.angular.z)


def _judge(task, file, robot) -> Tuple[Result, str]:
    """Return the result of the drive in a bag, and the name of its source. This runs in a child."""
    tracks = _read(file)
    robot, topic = _choose(tracks, robot)
    result = judge(task, tracks[robot, topic])
    if topic != GROUND_TRUTH:
        return result, "odometry"
    if result.drive.unexplained > UNEXPLAINED:
        raise NoDrive(MOVED)
    return result, changed(tracks.get((robot, BODY), [""])[-1])


def _read(file: str) -> Tracks:
    """Return the drives that a bag holds, by robot and topic. Raises ValueError with one sentence."""
    _forbid_code()
    try:
        _check(file)
        with _Bag(file) as bag:
            return _tracks(bag)
    except OSError as error:
        raise ValueError(f"It cannot be read: {error.strerror}.") from None
    except rosbag.ROSBagUnindexedException:
        raise ValueError("Its recording was cut short. Repair it with rosbag reindex.") from None
    except rosbag.bag.ROSBagEncryptException:
        raise ValueError("It is encrypted: hand in one that is not.") from None
    except (MemoryError, ValueError):
        raise
    except Exception as error:  # rosbag raises many kinds for a damaged file
        raise ValueError(f"It is damaged: {error}") from None


def _forbid_code():
    """Let rosbag use installed messages only: it would run Python code that it makes from a definition in the bag."""
    rosbag.bag._message_types.update({message._md5sum: message for message in TYPES.values()})
    genpy.dynamic.generate_dynamic = _refuse


def _refuse(name, _definition):
    raise ValueError(f"It is damaged: it holds {name} in place of another message.")


def _check(file):
    """Raise OSError or ValueError unless this is a file that begins as a rosbag."""
    files.check_regular(file)
    if os.path.getsize(file) > MAX_SIZE * 10 ** 6:
        raise ValueError(f"It is larger than {MAX_SIZE} MB.")
    with open(file, "rb") as stream:
        start = stream.read(len(MAGIC))
    if start != MAGIC:
        raise ValueError("It is not a rosbag." if start else "It is empty.")


class _Bag(rosbag.Bag):
    def set_encryptor(self, *_):
        """Refuse to decrypt, for which rosbag would start a program."""
        raise rosbag.bag.ROSBagEncryptException("encrypted")


def _tracks(bag: rosbag.Bag) -> Tracks:
    tracks = {}
    for topic, message, _ in bag.read_messages(connection_filter=_is_known):
        robot, name = TOPIC.fullmatch(topic).groups("")
        value = message.data if name == BODY else sample_of(message)
        tracks.setdefault((robot, name), []).append(value)
    return tracks


def _is_known(topic, kind, md5sum, _definition, _header):
    known = TOPIC.fullmatch(topic)
    message = TYPES[known[2]] if known else None
    return message and (kind, md5sum) == (message._type, message._md5sum)


def _choose(tracks: Tracks, robot: Optional[str]) -> Tuple[str, str]:
    """Return a robot, and the topic from which its drive is known best. Raises ValueError."""
    robots = sorted({each for each, topic in tracks if topic != BODY})
    if not robots:
        raise ValueError(f"It does not hold where the robot was: record {GROUND_TRUTH}, or {ODOM}.")
    if robot is None and len(robots) > 1 or robot not in (None, *robots):
        names = enumeration([each or "a robot without a name" for each in robots])
        raise ValueError(f"It holds {printable(names)}: choose one with --robot NAME.")
    robot = robots[0] if robot is None else robot
    return robot, GROUND_TRUTH if (robot, GROUND_TRUTH) in tracks else ODOM
