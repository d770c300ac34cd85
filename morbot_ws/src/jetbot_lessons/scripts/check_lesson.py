#!/usr/bin/env python3
"""Report what is missing after a lesson: rosrun jetbot_lessons check_lesson.py N [YOUR_PACKAGE].

For a teacher: check_lesson.py N --robots NAME ..., or N --folders FOLDER ..., reports it of a class as CSV.
"""

import signal
import sys

if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # while it imports, Ctrl-C prints no traceback

try:
    import os
    from argparse import ArgumentParser, ArgumentTypeError, Namespace
    from typing import List, NoReturn, Optional

    import rospy

    from driving_tasks.report import marks
    from jetbot import files
    from jetbot.host import by_morbot
    from jetbot.text import printable
    from jetbot_lessons.graph import report_loss
    from jetbot_lessons.lessons import FIRST_OWN, LAST, WITH_ROBOT, first_problem
    from jetbot_lessons.marking import DONE, Row, describe, mark_folders, mark_robots
except ImportError as error:
    sys.exit(f"{error}: open a shell with ./morbot shell, and type rosrun jetbot_lessons check_lesson.py N there.")

COMMAND = by_morbot("check", "rosrun jetbot_lessons check_lesson.py")
PUPILS_USAGE = f"{COMMAND} N, and from lesson {FIRST_OWN} on the name of your package"
TEACHERS_USAGE = (f"{COMMAND} N --robots NAME ... for lessons {WITH_ROBOT[0]} to {WITH_ROBOT[-1]}, "
                  f"N --folders FOLDER ... for {FIRST_OWN} to {LAST}, with --csv FILE.csv to write a file")
CANCELLED = 128 + signal.SIGINT  # exit code, as shells have it


def parse(arguments: List[str]) -> Namespace:
    """Return lesson, package, robots, folders and csv; raise SystemExit, with one sentence, for bad arguments."""
    parser = ArgumentParser(usage=f"{PUPILS_USAGE}; for a class, {TEACHERS_USAGE}", description="Checks a lesson.")
    parser.error = lambda message: sys.exit(
        printable(f"{message[0].upper()}{message[1:]}. Type: {PUPILS_USAGE}; for a class, {TEACHERS_USAGE}"))
    parser.add_argument("lesson", nargs="?", metavar="N", help=f"the lesson, 1 to {LAST}")
    parser.add_argument("package", nargs="?", help="the name of your package")
    of_class = parser.add_mutually_exclusive_group()
    of_class.add_argument("--robots", nargs="+", default=[], metavar="NAME", help="namespaces of robots of this master")
    of_class.add_argument("--folders", nargs="+", default=[], metavar="FOLDER",
                          help="packages that were handed in; nothing in them is executed")
    parser.add_argument("--csv", type=csv_file, metavar="FILE.csv", help="write the table of a class into this file")
    options = parser.parse_args(arguments)
    if options.lesson not in map(str, range(1, LAST + 1)):
        sys.exit(f"Which lesson, 1 to {LAST}? Type: {PUPILS_USAGE}")
    options.lesson = int(options.lesson)
    if options.robots or options.folders or options.csv:
        if options.lesson not in (WITH_ROBOT if options.robots else range(FIRST_OWN, LAST + 1)):
            parser.error(f"lesson {options.lesson} cannot be checked like this")
    elif options.lesson >= FIRST_OWN and not options.package:
        sys.exit(f"Lesson {options.lesson} is about your own package. Type: {COMMAND} {options.lesson} ITS_NAME")
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


def give_up(number: int, problem: str) -> NoReturn:
    """Report a problem from any thread, and end the program without rospy's last words to the master."""
    print(printable(f"Lesson {number}: {problem}"), file=sys.stderr, flush=True)
    os._exit(1)


def check_pupil(lesson: int, package: Optional[str]) -> int:
    """Check one pupil's work, and print "done", or what is missing; return the exit code."""
    problem = describe(lambda: first_problem(lesson, package or ""))
    print(printable(f"Lesson {lesson}: {problem or 'done.'}"), file=sys.stderr if problem else sys.stdout)
    return 1 if problem else 0


def check_class(options: Namespace) -> int:
    """Check a class's work, and print or write a table; return the exit code, 0 if all have done it."""
    rows = list(mark_robots(options.lesson, options.robots) if options.robots else
                mark_folders(options.lesson, options.folders))
    print(end=marks.to_csv(Row._fields, rows), flush=True)
    if options.csv:
        table = marks.Table(options.csv)
        table.write(Row._fields, rows)
        print(f"Wrote {table.file}.")
    return 0 if all(row.done == DONE for row in rows) else 1


def main() -> int:
    options = parse(rospy.myargv()[1:])
    if not options.folders:
        report_loss(lambda problem: give_up(options.lesson, problem))
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        if options.robots or options.folders:
            return check_class(options)
        return check_pupil(options.lesson, options.package)
    except KeyboardInterrupt:
        print("Cancelled.", file=sys.stderr)
        return CANCELLED


if __name__ == "__main__":
    sys.exit(main())
