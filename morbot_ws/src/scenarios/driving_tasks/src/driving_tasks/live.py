"""Judges robots that somebody else drives now."""

import contextlib
import time
from threading import Event, Thread
from typing import Callable, Iterator, List, Optional, Sequence

import rospy

from jetbot import InvalidValue, JetbotError, files
from jetbot.wait import wait_until
from jetbot_ros.master import NO_ANSWER, condition_of, is_registered, require_master

from .attempt import Attempt
from .bag_writer import BagWriter
from .marks import Mark
from .robot import SimulatedRobot, find_robots, label, system_state
from .tasks import Task

NAME = "judge"
POLL_INTERVAL = 0.05    # s
ASK_INTERVAL = 1.0      # s between two questions to the master
RESTORE_TIMEOUT = 1.0   # s until all simulators have their worlds back
SHUTDOWN_TIMEOUT = 2.0  # s; a frozen master never answers
LOST = JetbotError("the ROS master has ended, hangs or was restarted, or another judge took this one's place",
                   "Start the judge again.")


def judge_robots(task: Task, names: Sequence[str], record: Optional[str] = None) -> Iterator[Mark]:
    """Yield the mark of each simulated robot of these names, or of the only one there is, as its drive ends.

    Prints what the people who drive must know. record: a rosbag that gets what was judged, of one robot.
    At Ctrl-C, judges what was driven so far; raises KeyboardInterrupt if that is nothing, of one robot.
    Raises JetbotError if there is nothing to judge, OSError if the record cannot be written.
    """
    namespaces = find(names)
    check_only_judge(namespaces)
    if record:
        check_record(record, namespaces)
    init_node(namespaces)
    robots = [SimulatedRobot(namespace) for namespace in namespaces]
    attempts = [Attempt(task, robot, reporter(robot, robots), BagWriter(robot) if record else None) for robot in robots]
    try:
        check_only_judge(namespaces)  # again: two may have started at the same time
        for attempt in finished(attempts):
            if record and attempt.mark.result:
                attempt.writer.save(record)
            yield attempt.mark
    finally:
        close(robots)


def find(names: Sequence[str]) -> List[str]:
    """Return the namespaces of these robots; end the program if there is no master. Raise JetbotError."""
    require_master("roslaunch simulation simulation.launch")
    try:
        return find_robots(names)
    except NO_ANSWER as error:
        raise error if isinstance(error, InvalidValue) else LOST from None  # an InvalidValue is a ValueError too


def check_only_judge(namespaces: Sequence[str]) -> None:
    """Raise JetbotError if another node judges one of the robots."""
    try:
        publishers = system_state()[0]
        for namespace in namespaces:
            for node in publishers.get(f"{namespace}/task", ()):
                if node != rospy.get_name() and condition_of(node):
                    raise JetbotError(f"{node} judges {label(namespace) if namespace else 'this robot'} already",
                                      "End it first: Ctrl-C in its terminal; after Ctrl-Z, fg, then Ctrl-C.")
    except NO_ANSWER:
        raise LOST from None


def check_record(record: str, namespaces: Sequence[str]) -> None:
    """Raise InvalidValue or OSError unless what is judged can be written to this file."""
    if len(namespaces) > 1:
        raise InvalidValue("a record is of one robot", "Name one: --robot NAME")
    files.check_writable(record)


def init_node(namespaces: Sequence[str]) -> None:
    """Become the node judge, in the namespace of the only robot."""
    namespace = namespaces[0] if len(namespaces) == 1 else ""
    rospy.names._set_caller_id(f"{namespace}/unnamed")  # init_node takes its namespace from here
    rospy.init_node(NAME, argv=[], disable_signals=True)  # rospy's own handlers would ask the master


def reporter(robot: SimulatedRobot, robots: Sequence[SimulatedRobot]) -> Callable[[str], None]:
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
    lost = watch_master()
    steps = {attempt: attempt.steps() for attempt in attempts}
    while steps:
        if lost.is_set() or rospy.is_shutdown():
            raise LOST
        for attempt in list(steps):
            attempt.robot.poll()
            next(steps[attempt], None)
            if attempt.mark:
                del steps[attempt]
                yield attempt
        time.sleep(POLL_INTERVAL)


def watch_master() -> Event:
    """Return what is set once the master hangs, or no longer knows this node."""
    lost = Event()
    Thread(target=_ask_master, args=[lost], daemon=True).start()
    return lost


def _ask_master(lost: Event) -> None:
    failures = 0
    while failures < 2:  # a second question: it may have been busy
        time.sleep(ASK_INTERVAL)
        try:
            failures = 0 if is_registered() else 2
        except NO_ANSWER:
            failures += 1
    lost.set()


def close(robots: Sequence[SimulatedRobot]) -> None:
    """Give the robots their worlds back, and end the node."""
    with contextlib.suppress(rospy.ROSException):  # rospy has ended the node
        for robot in robots:
            robot.set_world("")
    wait_until(lambda: rospy.is_shutdown() or all(robot.has_world for robot in robots), RESTORE_TIMEOUT)
    ending = Thread(target=rospy.signal_shutdown, args=["the judge has ended"], daemon=True)
    ending.start()
    ending.join(SHUTDOWN_TIMEOUT)
