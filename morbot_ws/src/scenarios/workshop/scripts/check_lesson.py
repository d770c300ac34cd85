#!/usr/bin/env python3
"""Says what is still missing after a lesson, in one sentence: rosrun workshop check_lesson.py N [YOUR_PACKAGE]."""

import sys

try:
    import rosgraph
    import rospy
    from catkin_pkg.package import InvalidPackage

    from jetbot import JetbotError
    from lessons.table import LAST, first_missing, needs_package
except ImportError as error:
    sys.exit(f"{error}: open a shell with ./morbot shell, and type rosrun workshop check_lesson.py N there.")

USAGE = f"Which lesson, 1 to {LAST}? Type: rosrun workshop check_lesson.py N"


def lesson(given):
    """The number and the package's name in what was typed."""
    number, *names = given or [""]
    if not (number.isdecimal() and 1 <= int(number) <= LAST and len(names) <= 1):
        sys.exit(USAGE)
    if needs_package(int(number)) and not names:
        sys.exit(f"Lesson {number} is about your own package. Type: rosrun workshop check_lesson.py {number} ITS_NAME")
    return int(number), *names


def main():
    number, *own = lesson(rospy.myargv()[1:])
    sentence = first_missing(number, *own)
    if sentence:
        sys.exit(f"Lesson {number}: {sentence}")
    print(f"Lesson {number}: done.")


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit("Ended.")
    except EOFError:
        sys.exit("This lesson asks what you see: type it in a terminal.")
    except InvalidPackage as error:
        sys.exit(str(error))
    except (JetbotError, OSError, rosgraph.MasterException, rospy.ROSException) as error:
        sys.exit(f"Something went wrong while it looked: {error}")
