"""Marks a class: one row for each robot, or for each package that was handed in."""

import contextlib
import re
import sys
from argparse import Namespace
from pathlib import Path
from typing import Callable, Iterator, NamedTuple, Sequence

import rosgraph
import rospy
from catkin_pkg.package import InvalidPackage

from driving_tasks.report import marks
from jetbot.text import printable

from . import Problem
from .handed_in import find_package
from .table import find_problem, first_problem, handed_in_package

DONE = "yes"
ROBOT_NAME = re.compile(r"/?[A-Za-z]\w*(?:/\w+)*/?", re.ASCII)


class Row(NamedTuple):
    """Whether a robot, or a package, does what a lesson asks for; problem: the first one, "" without."""

    name: str
    lesson: int
    done: str
    problem: str


def mark_class(options: Namespace) -> Iterator[Row]:
    """Yield the row of each robot or folder. options: as class_options returns them."""
    if options.robots:
        return mark_robots(options.lesson, options.robots)
    return mark_folders(options.lesson, options.folders)


def as_csv(rows: Sequence[Row]) -> str:
    """Return the rows as CSV, below their names."""
    return marks.to_csv(Row._fields, rows)


def write_rows(rows: Sequence[Row], file: str) -> Problem:
    """Write the rows into a file in one step; return the problem if that fails."""
    try:
        marks.write(file, Row._fields, rows)
    except OSError as error:
        return f"{file} cannot be written: {error.strerror}"
    return None


def mark_robots(lesson: int, names: Sequence[str]) -> Iterator[Row]:
    """Yield a row for each robot of this master, by its namespace."""
    for name in names:
        yield _row(name, lesson, lambda name=name: _check_robot(lesson, name))


def mark_folders(lesson: int, folders: Sequence[str]) -> Iterator[Row]:
    """Yield a row for each package that was handed in."""
    for folder in folders:
        yield _row(folder, lesson, lambda folder=folder: find_problem(
            handed_in_package(find_package(Path(folder)))[lesson]))


def describe(find: Callable[[], Problem]) -> Problem:
    """Return the problem that a function finds, or why it cannot, in one sentence; None if there is none."""
    try:
        return find()
    except EOFError:
        return "this lesson asks what you see: run the check in a terminal"
    except InvalidPackage as error:
        return str(error)
    except (OSError, rosgraph.MasterException, rospy.ROSException) as error:
        return f"the check ended early: {error}; try again"


def _check_robot(lesson, name):
    if not ROBOT_NAME.fullmatch(name):
        return "A robot's name has letters, digits and _, such as jetbot_07"
    return first_problem(lesson, namespace=f"/{name.strip('/')}")


def _row(name, lesson, find):
    with contextlib.redirect_stdout(sys.stderr):  # what asks a person: the rows may be read by a program
        problem = describe(find) or ""
    return Row(printable(name), lesson, "no" if problem else DONE, printable(problem))
