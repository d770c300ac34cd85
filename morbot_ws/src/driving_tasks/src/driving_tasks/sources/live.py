"""Judges robots that somebody else drives now."""

import contextlib
import tempfile
import time
from collections import deque
from pathlib import Path
from threading import Thread
from typing import Callable, Iterator, List, Optional, Sequence, Tuple

import rosbag
import rospy
from nav_msgs.msg import Odometry
from std_msgs.msg import String

from jetbot import InvalidValue, JetbotError, files
from jetbot.wait import wait_until
from jetbot_ros import contract
from jetbot_ros.master import NO_ANSWER, address_of, condition_of, require_master, system_state

from ..report.marks import Mark
from ..scoring.tasks import Task
from .attempt import Attempt
from .judged_robot import JudgedRobot, choose_robots, label, simulated_robots

NAME = "judge"
POLL_INTERVAL = 0.05    # s
ASK_INTERVAL = 1.0      # s between two questions to the master
RESTORE_TIMEOUT = 1.0   # s until all simulators have their worlds back
SHUTDOWN_TIMEOUT = 2.0  # s; a frozen master never answers
MAX_MESSAGES = 100_000  # that are recorded; the oldest are dropped
LOST = JetbotError("the ROS master has ended, hangs or was restarted, or another judge took this one's place",
                   "Start the judge again.")

END_IT = "End it first: Ctrl-C in its terminal; after Ctrl-Z, fg, then Ctrl-C."
JUDGE_ME = "Somebody has pressed Judge me. Wait until that drive has ended."


def judge_robots(task: Task, names: Sequence[str], record: Optional[str] = None) -> Iterator[Mark]:
    """Yield the mark of each simulated robot of these names, or of the only one there is, as its drive ends.

    Prints what the people who drive must know. record: a rosbag that gets what was judged, of one robot.
    At Ctrl-C, judges what was driven so far; raises KeyboardInterrupt if that is nothing, of one robot.
    Raises JetbotError if there is nothing to judge, OSError if the record cannot be written.
    """
    namespaces = find(names)
    if record and len(namespaces) > 1:
        raise InvalidValue("a record is of one robot", "Name one: --robot NAME")
    if record:
        files.check_writable(record)
    init_node(namespaces)
    robots = [JudgedRobot(namespace, task.by_camera) for namespace in namespaces]
    attempts = [Attempt(task, robot, reporter(robot, robots)) for robot in robots]
    recording = Recording(attempts[0]) if record else None
    try:
        for attempt in finished(attempts):
            if recording and attempt.mark.result:
                recording.save(record)
            yield attempt.mark
    finally:
        close(robots)


def find(names: Sequence[str]) -> List[str]:
    """Return the namespaces of these robots; end the program if there is no master. Raise JetbotError."""
    require_master("roslaunch simulation simulation.launch")
    try:
        running = simulated_robots()
    except NO_ANSWER:
        raise LOST from None
    namespaces = choose_robots(names, running)
    check_only_judge(namespaces)
    return namespaces


def other_judges(namespaces: Sequence[str]) -> List[Tuple[str, str]]:
    """Return each other node that judges one of the robots, with that robot's namespace. Raise NO_ANSWER."""
    publishers = system_state()[0]
    return [(node, namespace) for namespace in namespaces
            for node in publishers.get(f"{namespace}/{contract.TASK}", ())
            if node != rospy.get_name() and condition_of(node)]


def check_only_judge(namespaces: Sequence[str]) -> None:
    """Raise JetbotError if another node judges one of the robots."""
    try:
        others = other_judges(namespaces)
    except NO_ANSWER:
        raise LOST from None
    for node, namespace in others:
        serves_all = node.rpartition("/")[2] == contract.CLASS_JUDGE
        raise JetbotError(f"{node} judges {label(namespace) if namespace else 'this robot'} already",
                          JUDGE_ME if serves_all else END_IT)


def init_node(namespaces: Sequence[str]) -> None:
    """Become the node judge, in the namespace of the only robot."""
    namespace = namespaces[0] if len(namespaces) == 1 else ""
    rospy.names._set_caller_id(f"{namespace}/unnamed")  # init_node takes its namespace from here
    rospy.init_node(NAME, argv=[], disable_signals=True)  # rospy's own handlers would ask the master


def reporter(robot: JudgedRobot, robots: Sequence[JudgedRobot]) -> Callable[[str], None]:
    """Return what prints a sentence about a robot, with its name if there are others."""
    prefix = f"{robot.name}: " if len(robots) > 1 else ""
    return lambda sentence: print(prefix + sentence, flush=True)


def finished(attempts: Sequence[Attempt]) -> Iterator[Attempt]:
    """Judge all at the same time; yield each as it ends. Ctrl-C ends all."""
    try:
        yield from run(attempts)
    except KeyboardInterrupt:
        rest = [attempt for attempt in attempts if not attempt.mark]
        for attempt in rest:
            attempt.finish()
        if len(attempts) == 1 and not attempts[0].mark.result:
            raise
        yield from rest


def run(attempts: Sequence[Attempt]) -> Iterator[Attempt]:
    """Judge all at the same time; yield each as it ends. Raise JetbotError."""
    waiting = list(attempts)
    for _ in polls():
        for attempt in waiting:
            attempt.step()
        yield from (attempt for attempt in waiting if attempt.mark)
        waiting = [attempt for attempt in waiting if not attempt.mark]
        if not waiting:
            return


def polls() -> Iterator[None]:
    """Yield every POLL_INTERVAL. Raise JetbotError once the master has ended, or does not know this node any more."""
    asked_at, failures = time.monotonic(), 0
    while True:
        if time.monotonic() - asked_at > ASK_INTERVAL:
            failures = 0 if is_known() else failures + 1
            asked_at = time.monotonic()
        if failures == 2 or rospy.is_shutdown():  # the first time, the master may have been busy
            raise LOST
        yield
        time.sleep(POLL_INTERVAL)


def is_known() -> bool:
    """Return whether the master answers, and knows this node."""
    try:
        return address_of(rospy.get_name()) == rospy.get_node_uri()
    except NO_ANSWER:
        return False


def close(robots: Sequence[JudgedRobot]) -> None:
    """Give the robots their worlds back, and end the node."""
    with contextlib.suppress(rospy.ROSException):  # rospy has ended the node
        for robot in robots:
            robot.set_world("")
    wait_until(lambda: rospy.is_shutdown() or all(robot.has_world for robot in robots), RESTORE_TIMEOUT)
    ending = Thread(target=rospy.signal_shutdown, args=["the judge has ended"], daemon=True)
    ending.start()
    ending.join(SHUTDOWN_TIMEOUT)


class Recording:
    """The ground truth and the body of the attempt's robot, as a rosbag that can be judged again."""

    def __init__(self, attempt: Attempt):
        self._attempt, self._robot = attempt, attempt.robot
        self._messages = deque(maxlen=MAX_MESSAGES)
        rospy.Subscriber(self._robot.truth_topic, Odometry, self._messages.append)

    def save(self, file: str) -> None:
        """Write what has arrived since the robot was at its start, in one step. Raises OSError."""
        with tempfile.TemporaryDirectory() as folder:
            bag_file = Path(folder, "drive.bag")
            with rosbag.Bag(str(bag_file), "w") as bag:
                start = self._attempt.start.time - self._robot.set_back
                bag.write(self._robot.body_topic, String(self._robot.body), rospy.Time.from_sec(start))
                for message in list(self._messages):
                    time = message.header.stamp
                    if time.to_sec() >= start:
                        bag.write(self._robot.truth_topic, message, time)
            files.replace(file, bag_file.read_bytes())
