"""Every Robot of this process that is not closed: the wheels stop when the process ends, a forked child lets go."""

import atexit
import contextlib
import os

from .errors import JetbotError

_robots = []


def add(robot) -> None:
    """Add a Robot, and close those on the same board, such as a notebook's cell leaves behind when it is run again."""
    place = (robot.driver.link.name, robot.driver.link.address)
    for other in list(_robots):
        if (other.driver.link.name, other.driver.link.address) == place:
            close(other)
    _robots.append(robot)


def remove(robot) -> None:
    """Remove a Robot that is closed."""
    if robot in _robots:
        _robots.remove(robot)


def close(robot) -> None:
    """Close a Robot; if its board does not answer, leave it to the guard."""
    with contextlib.suppress(JetbotError):
        robot.close()


def close_all() -> None:
    """At the interpreter's end: close every Robot."""
    for robot in list(_robots):
        close(robot)


def detach_all() -> None:
    """In a forked child: leave every Robot to the parent."""
    for robot in _robots:
        robot.detach()
    _robots.clear()


atexit.register(close_all)
os.register_at_fork(after_in_child=detach_all)
