#!/usr/bin/env python3
"""Makes this computer a robot of a class, which starts with it: ./morbot robot NAME --class CLASS. Needs no ROS."""

# ruff: noqa: E402
import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)

import sys

from jetbot import JetbotError
from jetbot.text import printable
from jetbot_class.robot.commands import main

if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except JetbotError as error:
        sys.exit(f"morbot: {error}")
    except OSError as error:
        sys.exit(f"morbot: {printable(error)}")
