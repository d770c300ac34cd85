"""Ends roslaunch before it touches anything, if the controller already runs: python3 -m jetbot_ros.already_running [NS]

A launch file makes this the command of a parameter: roslaunch runs it while it loads the file, and ends if it fails.
Else it prints nothing, so that the parameter is "", like one that is not given. NS: the controller's namespace.
"""

import os
import signal
import socket
import sys

# Options of a roslaunch that starts nothing, or uses another master than ROS_MASTER_URI.
OTHERS = {"-p", "--port", "--nodes", "--files", "--args", "--find-node", "--dump-params"}


def main(namespace: str = "") -> None:
    """If the node ``jetbot_controller`` in this namespace runs, print one sentence and end roslaunch."""
    if not is_start() or not master_listens():
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


def is_start() -> bool:
    """Return whether the parent of this process is a roslaunch that starts nodes; False where /proc hides that."""
    try:
        with open(f"/proc/{os.getppid()}/cmdline") as cmdline:
            words = cmdline.read().split("\0")
    except OSError:
        return False
    return "roslaunch" in map(os.path.basename, words[:3]) and not OTHERS.intersection(words)


def master_listens() -> bool:
    """Return whether there may be a ROS master; without one, no node runs."""
    host, _, port = os.environ.get("ROS_MASTER_URI", "").rstrip("/").rpartition("/")[2].rpartition(":")
    try:
        socket.create_connection((host or "localhost", int(port or 11311))).close()
    except (OSError, ValueError):
        return False
    return True


if __name__ == "__main__":
    main(*sys.argv[1:])
