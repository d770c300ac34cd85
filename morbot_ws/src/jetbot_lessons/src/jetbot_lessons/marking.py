"""Marks a class: one row for each robot, or for each package that was handed in."""

import contextlib
import sys
from pathlib import Path
from typing import Callable, Iterator, NamedTuple, Sequence

import rospy
from catkin_pkg.package import InvalidPackage

from jetbot.text import printable
from jetbot_ros.master import NO_ANSWER

from . import Problem
from .lessons import find_problem, first_problem, handed_in_package
from .packages import find_handed_in

DONE = "yes"


class Row(NamedTuple):
    """Whether a robot, or a package, does what a lesson asks for; problem: the first one, "" without."""

    name: str
    lesson: int
    done: str
    problem: str


def mark_robots(lesson: int, names: Sequence[str]) -> Iterator[Row]:
    """Yield a row for each robot of this master, by its namespace."""
    for name in names:
        yield _row(name, lesson, lambda name=name: first_problem(lesson, namespace=f"/{name.strip('/')}"))


def mark_folders(lesson: int, folders: Sequence[str]) -> Iterator[Row]:
    """Yield a row for each package that was handed in."""
    for folder in folders:
        yield _row(folder, lesson, lambda folder=folder: find_problem(
            handed_in_package(find_handed_in(Path(folder)))[lesson]))


def describe(find: Callable[[], Problem]) -> Problem:
    """Return the problem that a function finds, or why it cannot, in one sentence; None if there is none."""
    try:
        return find()
    except EOFError:
        return "this lesson asks what you see: run the check in a terminal"
    except InvalidPackage as error:
        return str(error)
    except (*NO_ANSWER, rospy.ROSException) as error:
        return f"the check ended early: {error}; try again"


def _row(name, lesson, find):
    with contextlib.redirect_stdout(sys.stderr):  # what asks a person: the rows may be read by a program
        problem = describe(find) or ""
    return Row(printable(name), lesson, "no" if problem else DONE, printable(problem))
