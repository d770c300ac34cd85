"""What a teacher types to check the work of a class."""

import sys
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from typing import List

from jetbot import files
from jetbot.text import printable

from .table import FIRST_OWN, LAST, WITH_ROBOT


def is_class(arguments: List[str]) -> bool:
    """Return whether these arguments ask for a class, and not for one pupil."""
    return any(argument.startswith("-") and not argument[1:].isdigit() for argument in arguments)


def parse_class(arguments: List[str], command: str) -> Namespace:
    """Return lesson, robots, folders and csv; raise SystemExit for bad arguments. command: what starts this program."""
    usage = (f"{command} N --robots NAME ... for lessons {WITH_ROBOT[0]} to {WITH_ROBOT[-1]}, "
             f"N --folders FOLDER ... for {FIRST_OWN} to {LAST}, with --csv FILE.csv to write a file")
    parser = ArgumentParser(usage=usage, description="Checks the work of a class, and prints a table as CSV: "
                                                     "name,lesson,done,problem.")
    parser.error = lambda message: sys.exit(printable(f"{message[0].upper()}{message[1:]}. Type: {usage}"))
    parser.add_argument("lesson", type=int, metavar="N", help=f"the lesson, {WITH_ROBOT[0]} to {LAST}")
    which = parser.add_mutually_exclusive_group(required=True)
    which.add_argument("--robots", nargs="+", default=[], metavar="NAME", help="namespaces of robots of this master")
    which.add_argument("--folders", nargs="+", default=[], metavar="FOLDER",
                       help="packages that were handed in; nothing in them is executed")
    parser.add_argument("--csv", type=csv_file, metavar="FILE.csv", help="write the table into this file")
    options = parser.parse_args(arguments)
    if options.lesson not in (WITH_ROBOT if options.robots else range(FIRST_OWN, LAST + 1)):
        parser.error(f"lesson {options.lesson} cannot be checked like this")
    return options


def csv_file(name: str) -> str:
    """Return the name of the file for the table; raise ArgumentTypeError before a class is checked, and not after."""
    if not name.endswith(".csv"):
        raise ArgumentTypeError(f"its name must end in .csv, not {name or 'nothing'}")
    try:
        files.check_writable(name)
    except OSError as error:
        raise ArgumentTypeError(f"{name} cannot be written: {error.strerror}") from None
    return name
