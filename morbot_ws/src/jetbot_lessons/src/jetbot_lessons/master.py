"""The ROS master: whether it answers, at the start and as long as the check runs."""

import time
from threading import Thread
from typing import Callable

from jetbot_ros.master import NO_ANSWER, is_reachable, master_uri

from . import Problem
from .nodes import CALLER, answer_in_time, connect

ASK_INTERVAL = 1.0  # s


def is_online() -> bool:
    """Return whether the master answers in time."""
    def call():
        try:
            return isinstance(connect(master_uri()).getPid(CALLER), list)
        except NO_ANSWER:
            return False

    return bool(answer_in_time(call))


def check_master(start: str = "roscore") -> Problem:
    """Return the problem, or None if a master runs; ``start`` is the command that starts one."""
    uri = master_uri()
    if is_online():
        return None
    if answer_in_time(lambda: is_reachable(uri)):
        return (f"The ROS master at {uri} does not answer: continue it (after Ctrl-Z: fg), "
                f"or stop it and start it with {start}")
    return f"No ROS master at {uri}: start one in another terminal with {start}"


def report_loss(callback: Callable[[str], None]) -> None:
    """In a thread, call back with the problem if a master no longer answers, for which rospy would wait forever."""
    Thread(target=lambda: _wait_for_problem(callback), daemon=True).start()


def _wait_for_problem(callback):
    if not is_online():
        return
    problem = None
    while not problem:
        time.sleep(ASK_INTERVAL)
        problem = None if is_online() else check_master()  # a second question: it may have been busy
    callback(problem)
