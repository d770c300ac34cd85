#!/usr/bin/env python3
"""Stops every robot, or with --release ends the stop, and reports what each one answers.

The exit code is 0 if there are robots, and all have confirmed. A robot that starts later is not stopped.
"""

# ruff: noqa: E402
import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)

import os
import sys
import threading
from typing import List

from jetbot.text import closest, printable
from jetbot_ros.master import NO_ANSWER, ask_master, is_reachable, master_uri

CONFIRM_TIMEOUT = 2.0   # s for the robots
TIMEOUT = 8.0           # s for all: rospy waits forever for a master that freezes meanwhile
SHUTDOWN_TIMEOUT = 1.0  # s for the end of this node
SWITCH = "If a robot moves, use its switch."


def is_stop(arguments: List[str]) -> bool:
    """Return whether the robots are to be stopped, and not released; raise SystemExit. In doubt, they are stopped."""
    if {"-h", "--help"}.intersection(arguments):
        print(__doc__.strip())
        sys.exit()
    unknown = [word for word in arguments if word != "--release" and ":=" not in word]
    if unknown and closest(unknown[0], ["release"]):
        sys.exit(f"There is no option {printable(unknown[0])}. Did you mean --release?")
    if unknown:
        print(f"There is no option {printable(unknown[0])}: this stops every robot.", file=sys.stderr)
    return bool(unknown) or "--release" not in arguments


def check_master() -> None:
    """End the program with one sentence if no master answers."""
    if not is_reachable(master_uri()):
        sys.exit(f"No ROS master at {master_uri()}, so no robot can be reached. {SWITCH}")
    try:
        ask_master("getPid")
    except NO_ANSWER:
        no_answer()


def no_answer() -> None:
    """End the process, whatever its other threads do."""
    print(f"The ROS master at {master_uri()} does not answer, so no robot can be reached. {SWITCH}", file=sys.stderr)
    os._exit(1)


def after(seconds: float, action, *arguments) -> threading.Timer:
    """Start and return a timer that does not keep the process alive."""
    timer = threading.Timer(seconds, action, arguments)
    timer.daemon = True
    timer.start()
    return timer


def stop(engaged: bool) -> bool:
    """Stop or release all robots, and print a line for each; return whether there are some, and all have confirmed."""
    try:
        import rospy  # here: it takes long to import

        from jetbot_tools.fleet import Fleet
    except ImportError as error:
        sys.exit(f"{error}. First run: ./morbot setup")
    rospy.init_node("emergency_stop", anonymous=True, disable_rosout=True, disable_signals=True)
    fleet = Fleet(engaged)
    if not fleet.wait(CONFIRM_TIMEOUT):
        fleet.remove_dead()
    unconfirmed = fleet.unconfirmed()
    for name, status in sorted(fleet.statuses.items()):
        print(printable(f"{name}: {status or 'no answer'}{' (not confirmed)' if name in unconfirmed else ''}"))
    if unconfirmed or not fleet.statuses:
        print(f"{'Not every robot confirms' if unconfirmed else f'No robot runs on the ROS master at {master_uri()}'}. "
              f"{SWITCH} Then repeat this.")
    return bool(fleet.statuses) and not unconfirmed


def main() -> None:
    engaged = is_stop(sys.argv[1:])
    check_master()
    limit = after(TIMEOUT, no_answer)
    try:
        code = 0 if stop(engaged) else 1
    except NO_ANSWER:
        no_answer()
    limit.cancel()
    sys.stdout.flush()
    after(SHUTDOWN_TIMEOUT, os._exit, code)
    sys.exit(code)


if __name__ == "__main__":
    main()
