#!/usr/bin/env python3
"""A page that drives a robot through the cockpit until it is ended: page.py PORT ROBOT SPEED.

After a break, its finger lifts and presses again, as a person's would.
"""

import contextlib
import sys
import threading
import time
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "ros"))
from web_client import Closed, WebSocket  # noqa: E402

PERIOD = 0.05        # s between two commands
RETRY_INTERVAL = 0.5  # s until a page connects again


def listen(page: WebSocket, robot: str) -> None:
    """Answer what the cockpit sends; lift the finger when it says so."""
    with contextlib.suppress(Closed, OSError, ValueError):
        while True:
            if page.receive()["type"] == "lift":
                page.send({"type": "drive", "robot": robot, "forward": 0.0, "left": 0.0})


def drive(port: int, robot: str, speed: float) -> None:
    """Drive until the connection is lost."""
    page = WebSocket(port, {"Host": f"localhost:{port}", "Origin": f"http://localhost:{port}"})
    threading.Thread(target=listen, args=[page, robot], daemon=True).start()
    while True:
        page.send({"type": "drive", "robot": robot, "forward": speed, "left": 0.0})
        time.sleep(PERIOD)


def main(port: str, robot: str, speed: str) -> None:
    while True:
        with contextlib.suppress(Closed, OSError, ValueError, IndexError):
            drive(int(port), robot, float(speed))
        time.sleep(RETRY_INTERVAL)


if __name__ == "__main__":
    main(*sys.argv[1:])
