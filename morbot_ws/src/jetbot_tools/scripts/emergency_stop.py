#!/usr/bin/env python3
"""Stops every robot, or with --release ends the stop, and reports what each one answers.

The exit code is 0 if there are robots, and all have confirmed. A robot that starts later is not stopped.
"""

import jetbot_ros.boot

import os
import signal
import socket
import sys
import time
from typing import Callable, List

from jetbot.text import closest, printable
from jetbot_ros import failures
from jetbot_ros.master import NO_ANSWER, ask_master, master_uri

SWITCH = "If a robot moves, use its switch."
CONFIRM_TIMEOUT = 2.0   # s for the robots
TIMEOUT = 8.0           # s for all: rospy waits forever for a master that freezes meanwhile
SHUTDOWN_TIMEOUT = 1.0  # s to unregister this node


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
    try:
        ask_master("getPid")
    except socket.timeout:
        no_answer()
    except NO_ANSWER:
        sys.exit(f"No ROS master at {master_uri()}, so no robot can be reached. {SWITCH}")


def no_answer() -> None:
    """End the process, whatever its other threads do."""
    print(f"The ROS master at {master_uri()} does not answer, so no robot can be reached. {SWITCH}", file=sys.stderr)
    os._exit(1)


def after(seconds: float, action: Callable[[], None]) -> None:
    """Do this after so many seconds, whatever the process then waits for, and no longer what was set before."""
    signal.signal(signal.SIGALRM, lambda *_: action())
    signal.setitimer(signal.ITIMER_REAL, seconds)


def stop(engaged: bool) -> int:
    """Stop or release all robots, and print a line for each; return the exit code."""
    try:
        from jetbot_tools.fleet import Fleet  # here: rospy takes long to import
    except ModuleNotFoundError as error:
        sys.exit(f"{error}. First run: ./morbot setup")
    failures.before_end.append(lambda: time.sleep(CONFIRM_TIMEOUT))  # robots that are reached stop
    fleet = Fleet(engaged)
    if not fleet.wait(CONFIRM_TIMEOUT):
        fleet.remove_dead()
    unconfirmed = fleet.unconfirmed()
    for name, state in sorted(fleet.states.items()):
        print(printable(f"{name}: {state.sentence or 'no answer'}{' (not confirmed)' if name in unconfirmed else ''}"))
    if unconfirmed or not fleet.states:
        print(f"{'Not every robot confirms' if unconfirmed else f'No robot runs on the ROS master at {master_uri()}'}. "
              f"{SWITCH} Then repeat this.")
    code = 0 if fleet.states and not unconfirmed else 1
    sys.stdout.flush()
    after(SHUTDOWN_TIMEOUT, lambda: os._exit(code))
    fleet.leave()
    return code


def main() -> None:
    failures.install(SWITCH)
    engaged = is_stop(sys.argv[1:])
    check_master()
    after(TIMEOUT, no_answer)
    try:
        os._exit(stop(engaged))  # rospy's threads, which have nothing left to do, would take seconds
    except NO_ANSWER:
        no_answer()


if __name__ == "__main__":
    main()
