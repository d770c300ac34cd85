#!/usr/bin/env python3
"""Deletes what a class has kept on this computer: its codes, names, programs, tasks and best scores."""

import argparse
import sys

from jetbot.text import printable
from jetbot_cockpit.classroom.folder import Busy, forget, path_of
from jetbot_cockpit.classroom.place import CLASS_NAME, FOLDER


def main() -> str:
    """Delete the class that was typed; return why not, or ""."""
    parser = argparse.ArgumentParser(prog="./morbot forget", description=__doc__, allow_abbrev=False)
    parser.add_argument("name", metavar="CLASS", help="its name, as in class.launch class:=CLASS")
    parser.add_argument("--classes", metavar="FOLDER", default=FOLDER, help=f"where it is kept (default: {FOLDER})")
    given = parser.parse_args()
    name, path = printable(given.name), path_of(given.classes, given.name)
    if not given.name or not CLASS_NAME.accepts(given.name):
        return f"{name} is no name of a class, which has {CLASS_NAME.description}."
    if (path / "fleet.json").exists():  # with the key that its robots have
        return f"{name} is a class of real robots, which this deletes: ./morbot fleet --class {name} forget"
    try:
        count = forget(given.classes, given.name)
    except Busy:
        return f"A cockpit runs with the class {name}: end it first."
    except OSError as error:
        return f"Not all of {path} was deleted: {error.strerror or error}."
    if count is None:
        return f"There is no class {name}: {path} does not exist."
    print(f"Deleted {path}: {count} files with the codes, names, programs and best scores of the class {name}.")
    return ""


if __name__ == "__main__":
    sys.exit(main() or 0)
