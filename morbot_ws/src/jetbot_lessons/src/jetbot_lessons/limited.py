"""Checks of what others have written: in a child process with limits, so that no file can stop the program."""

from functools import partial
from typing import Callable

from catkin_pkg.package import InvalidPackage

from driving_tasks import contained

from . import Problem

LIMITS = contained.Limits(memory=1000, cpu_time=10, wall_time=30)


def limited(check: Callable[..., Problem], package: object, *arguments: object) -> Callable[[], Problem]:
    """Return a function that returns the check's problem, or why the check did not end."""
    return partial(_run, check, package, *arguments)


def _run(check, package, *arguments):
    outcome = contained.run(_check, check, package, *arguments, limits=LIMITS)
    return f"The files of {package} cannot be checked: {outcome.problem}" if outcome.problem else outcome.value


def _check(check, *arguments):
    try:
        return check(*arguments)
    except InvalidPackage as error:
        return str(error)
