#!/usr/bin/env python3
"""Report what is missing after a lesson: rosrun jetbot_lessons check_lesson.py N [YOUR_PACKAGE]."""

import signal
import sys

if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # while it imports, and at its end, Ctrl-C prints no traceback

try:
    import os
    from typing import List, NoReturn, Tuple, Union

    import rosgraph
    import rospy
    from catkin_pkg.package import InvalidPackage

    from jetbot.host import by_morbot
    from jetbot.text import printable
    from jetbot_lessons.master import report_loss
    from jetbot_lessons.table import FIRST_OWN, LAST, first_problem
except ImportError as error:
    sys.exit(f"{error}: open a shell with ./morbot shell, and type rosrun jetbot_lessons check_lesson.py N there.")

COMMAND = by_morbot("check", "rosrun jetbot_lessons check_lesson.py")
USAGE = (f"Which lesson, 1 to {LAST}? Type: {COMMAND} N, "
         f"and from lesson {FIRST_OWN} on the name of your package")
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


def find_problem(number: int, *own: str) -> Union[str, Exception, None]:
    """Return the first problem of a lesson, or None if it is done; raise KeyboardInterrupt at Ctrl-C."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        return first_problem(number, *own)
    except EOFError:
        return "this lesson asks what you see: run the check in a terminal"
    except InvalidPackage as error:
        return error
    except (OSError, rosgraph.MasterException, rospy.ROSException) as error:
        return f"the check ended early: {error}; try again"
    finally:
        signal.signal(signal.SIGINT, signal.SIG_DFL)


def give_up(number: int, problem: str) -> NoReturn:
    """Report a problem from any thread, and end the program without rospy's last words to the master."""
    print(printable(f"Lesson {number}: {problem}"), file=sys.stderr, flush=True)
    os._exit(1)


def main() -> None:
    number, *own = parse_arguments(rospy.myargv()[1:])
    report_loss(lambda problem: give_up(number, problem))
    try:
        problem = find_problem(number, *own)
    except KeyboardInterrupt:
        print("Cancelled.", file=sys.stderr)
        sys.exit(CANCELLED)
    try:
        if not problem:
            print(f"Lesson {number}: done.")
        print(end="", flush=True)
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # else Python complains at its end
        problem = problem or f"the result cannot be printed: {error.strerror}"
    if problem:
        sys.exit(printable(f"Lesson {number}: {problem}"))


if __name__ == "__main__":
    main()
