#!/usr/bin/env python3
"""Starts RViz with a configuration for one robot; in a namespace, with the frames of that robot."""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

TRIES = 3  # without a graphics card it may crash at its start: Mesa draws into a window that X does not know yet


def main(config: str, *ros_arguments: str) -> int:
    if not shutil.which("rviz"):
        print("To see the robot here: sudo apt install rviz", flush=True)
        return 0
    name = os.environ.get("ROS_NAMESPACE", "").strip("/")
    view = (Path(config).read_text()  # with the robot's own frames; relative topic names need no change
            .replace('TF Prefix: ""', f'TF Prefix: "{name}"')
            .replace("Frame: base_footprint", f'Frame: "{os.path.join(name, "base_footprint")}"'))
    title = f"MorBot {name.replace('/', ' ')}".strip()  # of the window: RViz takes the file's name
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, title).write_text(view)
        for tries in range(1, TRIES + 1):
            code = subprocess.call(["rviz", "-d", title, *ros_arguments], cwd=folder)
            if code not in (-signal.SIGSEGV, -signal.SIGABRT):
                break
            print(f"RViz crashed, {tries} of {TRIES} times", flush=True)
    return code


if __name__ == "__main__":
    try:
        sys.exit(main(*sys.argv[1:]))
    except KeyboardInterrupt:
        pass
