"""The program's clock. While a program waits, its callbacks run: here, ROS has no threads of its own."""

import time

from _page import at, seconds
from _page import turn as _turn

LATEST = 0.05  # s without a turn, after which asking for the time gives the page one

local = {}  # the variables of the function that runs, as the last mark saw them
tasks = []  # what runs while the program waits: rospy's Subscribers and Timers
_epoch = time.time() - seconds()  # when the program started, in s since 1970
_turned = 0.0  # when the page had its last turn


def now():
    """Return the time of day in s since 1970; it stands while the program is paused."""
    poll()
    return _epoch + seconds()


def add(task):
    """Run this, too; also while the program neither waits nor asks for the time."""
    tasks.append(task)


def mark(_line, **variables):
    """Give the page its turn before this line, in a function with these variables."""
    global local
    local = variables
    at(_line)
    if tasks:
        poll()


names = {"__name__": "__main__", "_at": mark}  # the program's own


def poll():
    """Run the tasks if the program computes for long: a loop may ask for nothing but the time."""
    if seconds() - _turned > LATEST:
        turn(0)


def turn(duration):
    """Wait so many s, then run the tasks."""
    global _turned
    _turn(float(max(0, duration)))  # a whole number would be cut to 32 bits
    _turned = seconds()
    for task in list(tasks):
        task.run()


def wait(duration):
    """Wait so many s, in pieces as short as the tasks need them."""
    end = seconds() + duration
    while duration > 1e-6:
        turn(min([duration] + [task.patience() for task in tasks]))
        duration = end - seconds()
