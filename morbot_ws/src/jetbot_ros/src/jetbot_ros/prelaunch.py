"""Ends roslaunch before it touches anything, if an argument is mistyped, or a node already runs.

A launch file makes ``python3 -m jetbot_ros.prelaunch [NAMESPACE [NODE]]`` the command of a parameter, so that roslaunch
runs it while it loads the file. It prints nothing on stdout: the parameter is "", like one that is not given.
"""

# ruff: noqa: E402
import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C reaches this process too, and simply ends it

import os
import sys

from .launch_arguments import argument_problem
from .master import is_reachable, master_uri
from .roslaunch_command import end_roslaunch, parent_words, parse

READING_TIMEOUT = 5.0  # s for the launch files; then nothing is refused


def main(namespace: str = "", node: str = "jetbot_controller") -> None:
    """Print one sentence and end roslaunch, if it must not go on. namespace: of the node; "/NAME" is the whole name."""
    words = parent_words()
    if not words:
        return
    command = parse(words)
    problem = argument_problem_in_time(command.files, command.typed)
    if problem:
        end_roslaunch(problem)
    if command.port:
        os.environ["ROS_MASTER_URI"] = f"http://localhost:{command.port}"
    if is_reachable(master_uri()):  # without a master, no node runs
        check_not_running(namespace, node)


def argument_problem_in_time(files, typed):
    """Return what ``argument_problem`` does, or None if that takes too long."""
    def give_up(*_):
        raise TimeoutError  # an OSError: argument_problem() then returns None
    signal.signal(signal.SIGALRM, give_up)
    signal.setitimer(signal.ITIMER_REAL, READING_TIMEOUT)
    try:
        return argument_problem(files, typed)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)


def check_not_running(namespace: str, node: str) -> None:
    """End roslaunch if the node in this namespace runs, or the master does not answer."""
    from .master import require_master, require_name  # here: they take longer to import than all the rest
    parts = [node] if node.startswith("/") else [os.environ.get("ROS_NAMESPACE", ""), namespace, node]
    try:
        require_master()
        require_name("/" + "/".join(filter(None, (part.strip("/") for part in parts))))
    except SystemExit as refusal:
        end_roslaunch(refusal)


if __name__ == "__main__":
    main(*sys.argv[1:])
