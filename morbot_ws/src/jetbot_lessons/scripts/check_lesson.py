#!/usr/bin/env python3
"""Report what is missing after a lesson: rosrun jetbot_lessons check_lesson.py N [YOUR_PACKAGE]."""

import sys
from typing import List, Tuple, Union

try:
    import rosgraph
    import rospy
    from catkin_pkg.package import InvalidPackage

    from jetbot.text import printable
    from jetbot_lessons.table import FIRST_OWN, LAST, first_problem
except ImportError as error:
    sys.exit(f"{error}: open a shell with ./morbot shell, and type rosrun jetbot_lessons check_lesson.py N there.")

USAGE = (f"Which lesson, 1 to {LAST}? Type: rosrun jetbot_lessons check_lesson.py N, "
         f"and from lesson {FIRST_OWN} on the name of your package")


def parse_arguments(arguments: List[str]) -> Tuple[Union[int, str], ...]:
    """Return the lesson's number and the package's name, if it has one; raise SystemExit for bad arguments."""
    number, *names = arguments or [""]
    if number not in map(str, range(1, LAST + 1)) or len(names) > 1:
        sys.exit(USAGE)
    if int(number) >= FIRST_OWN and not names:
        sys.exit(f"Lesson {number} is about your own package. "
                 f"Type: rosrun jetbot_lessons check_lesson.py {number} ITS_NAME")
    return int(number), *names


def main() -> None:
    number, *own = parse_arguments(rospy.myargv()[1:])
    try:
        problem = first_problem(number, *own)
    except KeyboardInterrupt:
        sys.exit("Cancelled.")
    except EOFError:
        problem = "this lesson asks what you see: run the check in a terminal"
    except InvalidPackage as error:
        problem = error
    except (OSError, rosgraph.MasterException, rospy.ROSException) as error:
        problem = f"the check ended early: {error}; try again"
    if problem:
        sys.exit(printable(f"Lesson {number}: {problem}"))
    print(f"Lesson {number}: done.")


if __name__ == "__main__":
    main()
