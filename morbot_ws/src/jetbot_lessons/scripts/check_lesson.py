#!/usr/bin/env python3
"""Report what is missing after a lesson: rosrun jetbot_lessons check_lesson.py N [YOUR_PACKAGE]."""

import sys

try:
    import rosgraph
    import rospy
    from catkin_pkg.package import InvalidPackage

    from jetbot import JetbotError
    from jetbot_lessons.table import FIRST_OWN, LAST, first_missing
except ImportError as error:
    sys.exit(f"{error}: open a shell with ./morbot shell, and type rosrun jetbot_lessons check_lesson.py N there.")

USAGE = (f"Which lesson, 1 to {LAST}? Type: rosrun jetbot_lessons check_lesson.py N, "
         f"and from lesson {FIRST_OWN} on the name of your package")


def lesson(given):
    """The number and the package's name in what was typed."""
    number, *names = given or [""]
    if number not in map(str, range(1, LAST + 1)) or len(names) > 1:
        sys.exit(USAGE)
    if int(number) >= FIRST_OWN and not names:
        sys.exit(f"Lesson {number} is about your own package. "
                 f"Type: rosrun jetbot_lessons check_lesson.py {number} ITS_NAME")
    return int(number), *names


def found_out(number, *own):
    """The sentence of what is missing, or of what hindered the look; None when all is there."""
    try:
        return first_missing(number, *own)
    except EOFError:
        return "this one asks what you see: type it in a terminal."
    except InvalidPackage as error:
        return str(error)
    except (JetbotError, OSError, rosgraph.MasterException, rospy.ROSException) as error:
        return f"the look ended with {error}. Try again."


def main():
    number, *own = lesson(rospy.myargv()[1:])
    sentence = found_out(number, *own)
    if sentence:
        sys.exit(f"Lesson {number}: {sentence}")
    print(f"Lesson {number}: done.")


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit("Ended.")
