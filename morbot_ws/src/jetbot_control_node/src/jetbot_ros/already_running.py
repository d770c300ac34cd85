"""Ends roslaunch before it touches anything, if the controller already runs: python3 -m jetbot_ros.already_running [NS]

A launch file makes this the command of a parameter: roslaunch runs it while it loads the file, and ends if it fails.
Else it prints nothing, so that the parameter is "", like one that is not given. NS: the controller's namespace.
"""

import argparse
import os
import signal
import sys
from typing import List

from .addresses import is_reachable, master_uri

LISTING = {"--nodes", "--files", "--args", "--find-node", "--dump-params"}  # options of a roslaunch that starts nothing


def main(namespace: str = "") -> None:
    """If the node ``jetbot_controller`` in this namespace runs, print one sentence and end roslaunch."""
    words = roslaunch_command()
    if not words or LISTING.intersection(words):
        return
    set_master(words)
    if not is_reachable(master_uri()):  # without a master, no node runs
        return
    from .master import require_master, require_name  # here: they take longer to import than all the rest
    parts = (os.environ.get("ROS_NAMESPACE", ""), namespace, "jetbot_controller")
    try:
        require_master()
        require_name("/" + "/".join(filter(None, (part.strip("/") for part in parts))))
    except SystemExit as refusal:
        print(refusal, file=sys.stderr, flush=True)
        os.kill(os.getppid(), signal.SIGTERM)  # else it prints a page of XML; it has not started anything yet
        sys.exit(1)


def roslaunch_command() -> List[str]:
    """Return the command line of the roslaunch that is this process's parent; nothing where /proc hides that."""
    try:
        with open(f"/proc/{os.getppid()}/cmdline") as cmdline:
            words = cmdline.read().split("\0")
    except OSError:
        return []
    return words if "roslaunch" in map(os.path.basename, words[:3]) else []


def set_master(words: List[str]) -> None:
    """Make ROS_MASTER_URI the master of the roslaunch with this command line: its option --port names another."""
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("-p", "--port")
    port = parser.parse_known_args(words)[0].port
    if port:
        os.environ["ROS_MASTER_URI"] = f"http://localhost:{port}"


if __name__ == "__main__":
    main(*sys.argv[1:])
