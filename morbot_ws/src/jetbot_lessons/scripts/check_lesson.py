#!/usr/bin/env python3
"""Report what is missing after a lesson: rosrun jetbot_lessons check_lesson.py N [YOUR_PACKAGE].

For a teacher: check_lesson.py N --robots NAME ..., or N --folders FOLDER ..., reports it of a class as CSV.
"""

import signal
import sys

if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # while it imports, and at its end, Ctrl-C prints no traceback

try:
    import os
    from typing import Callable, List, NoReturn, Optional, Tuple, TypeVar, Union

    import rospy

    from jetbot.host import by_morbot
    from jetbot.text import printable
    from jetbot_lessons.class_options import is_class, parse_class
    from jetbot_lessons.marking import DONE, as_csv, describe, mark_class, write_rows
    from jetbot_lessons.master import report_loss
    from jetbot_lessons.table import FIRST_OWN, LAST, first_problem
except ImportError as error:
    sys.exit(f"{error}: open a shell with ./morbot shell, and type rosrun jetbot_lessons check_lesson.py N there.")

COMMAND = by_morbot("check", "rosrun jetbot_lessons check_lesson.py")
USAGE = (f"Which lesson, 1 to {LAST}? Type: {COMMAND} N, "
         f"and from lesson {FIRST_OWN} on the name of your package")
T = TypeVar("T")
CANCELLED = 128 + signal.SIGINT  # exit code, as shells have it


def parse_arguments(arguments: List[str]) -> Tuple[Union[int, str], ...]:
    """Return the lesson's number and the package's name, if it has one; raise SystemExit for bad arguments."""
    number, *names = arguments or [""]
    if number not in map(str, range(1, LAST + 1)) or len(names) > 1:
        sys.exit(USAGE)
    if int(number) >= FIRST_OWN and not names:
        sys.exit(f"Lesson {number} is about your own package. "
                 f"Type: {COMMAND} {number} ITS_NAME")
    return int(number), *names


def give_up(number: int, problem: str) -> NoReturn:
    """Report a problem from any thread, and end the program without rospy's last words to the master."""
    print(printable(f"Lesson {number}: {problem}"), file=sys.stderr, flush=True)
    os._exit(1)


def check_pupil(arguments: List[str]) -> Optional[str]:
    """Check one pupil's work, and print "done"; return the message if it is not. Raise KeyboardInterrupt at Ctrl-C."""
    number, *own = parse_arguments(arguments)
    report_loss(lambda problem: give_up(number, problem))
    problem = cancellable(lambda: describe(lambda: first_problem(number, *own)))
    problem = problem or write(f"Lesson {number}: done.\n")
    return problem and f"Lesson {number}: {problem}"


def check_class(arguments: List[str]) -> Optional[str]:
    """Check a class's work, and print or write a table; return the message of a failure, "" if not all have done it."""
    options = parse_class(arguments, COMMAND)
    if options.robots:
        report_loss(lambda problem: give_up(options.lesson, problem))
    rows = cancellable(lambda: list(mark_class(options)))
    problem = write(as_csv(rows))
    if options.csv:
        problem = write_rows(rows, options.csv) or problem or write(f"Wrote {options.csv}.\n")
    return problem or (None if all(row.done == DONE for row in rows) else "")


def cancellable(function: Callable[[], T]) -> T:
    """Return what a function returns; raise KeyboardInterrupt at Ctrl-C."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        return function()
    finally:
        signal.signal(signal.SIGINT, signal.SIG_DFL)


def write(text: str) -> Optional[str]:
    """Print the result; return the problem if it cannot be printed."""
    try:
        print(end=text, flush=True)
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # else Python complains at its end
        return f"the result cannot be printed: {error.strerror}"
    return None


def main() -> None:
    arguments = rospy.myargv()[1:]
    try:
        problem = (check_class if is_class(arguments) else check_pupil)(arguments)
    except KeyboardInterrupt:
        print("Cancelled.", file=sys.stderr)
        sys.exit(CANCELLED)
    if problem is not None:
        sys.exit(printable(problem) or 1)


if __name__ == "__main__":
    main()
