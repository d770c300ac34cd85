#!/usr/bin/env python3
"""Looks after a class of real robots from the teacher's computer. Needs no ROS."""

# ruff: noqa: E402
import sys
from pathlib import Path

for folder in Path(__file__).resolve().parents[2].glob("*/src"):  # no catkin has put it on the path
    sys.path.insert(0, str(folder))

try:
    from jetbot_class.fleet.commands import main
except ImportError as error:
    if error.name != "tornado":
        raise
    sys.exit(f"There is no tornado for {sys.executable}: {sys.executable} -m pip install tornado segno zeroconf")

if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        sys.exit(130)
