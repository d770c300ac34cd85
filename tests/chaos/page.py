#!/usr/bin/env python3
"""A page of the cockpit. Arguments: ADDRESS PORT COOKIE, then drive ROBOT SPEED; stop, release or go_on ROBOT ...;
or judge ROBOT.

One that drives does so until it is ended; after a break, its finger lifts and presses again. The others end as soon as
these robots have confirmed; with 1 if the cockpit refuses that.
"""

import contextlib
import os
import sys
import threading
import time
from pathlib import Path
from typing import Dict, Sequence

sys.path.append(str(Path(__file__).resolve().parents[1] / "ros"))
from web_client import Closed, WebSocket, page_headers  # noqa: E402

PERIOD = 0.05         # s between two commands
RETRY_INTERVAL = 0.5  # s until a page connects again
TASK = "metre"
HOST = "morbot" if "CHAOS_ISOLATED" in os.environ else "localhost"  # by which everybody is the teacher


def connect(address: str, port: str, cookie: str) -> WebSocket:
    return WebSocket(int(port), headers(int(port), cookie), "", address)


def headers(port: int, cookie: str) -> Dict[str, str]:
    return page_headers(port, HOST, Cookie=f"jetbot_cockpit_{port}={cookie}")


def listen(page: WebSocket, robot: str) -> None:
    """Answer what the cockpit sends; lift the finger when it says so."""
    with contextlib.suppress(Closed, OSError, ValueError):
        while True:
            message = page.receive()
            if message["type"] == "lift":
                print(message["text"], flush=True)
                page.send({"type": "drive", "robot": robot, "forward": 0.0, "left": 0.0})


def drive(page: WebSocket, robot: str, speed: float) -> None:
    """Drive until the connection is lost."""
    threading.Thread(target=listen, args=[page, robot], daemon=True).start()
    while True:
        page.send({"type": "drive", "robot": robot, "forward": speed, "left": 0.0})
        time.sleep(PERIOD)


def is_as_wanted(robot: dict, action: str) -> bool:
    """Return whether a robot of the message "state" is stopped; or is not, and no program waits; or is judged."""
    if action == "judge":
        return bool(robot["task"]) and (robot["task"]["name"], robot["task"]["state"]) == (TASK, "ready")
    stopped = "emergency_stop" in robot["holds"]
    return stopped if action == "stop" else not (stopped or action == "go_on" and robot["held"])


def act(page: WebSocket, action: str, robots: Sequence[str]) -> None:
    """Stop all robots, or release them, also let their programs go on, or judge one; wait until they confirm it."""
    page.send({"type": "release"} if action == "go_on" else {"type": action, "robot": robots[0], "task": TASK}
              if action == "judge" else {"type": action})
    for robot in robots if action == "go_on" else ():
        page.send({"type": "go_on", "robot": robot})
    message = page.receive_until(lambda message: problem_of(message) or message["type"] == "state" and all(
        robot in message["robots"] and is_as_wanted(message["robots"][robot], action)
        or action == "judge" and page.send({"type": "program", "robot": robot}) for robot in robots))
    if problem_of(message):
        sys.exit(problem_of(message))


def problem_of(message: dict) -> str:
    """Return why the cockpit refuses something, or "" if this message is about something else."""
    refusal = message if message["type"] == "notice" else message.get("refusal")
    return refusal["text"] if refusal else ""


def main(address: str, port: str, cookie: str, action: str, *arguments: str) -> None:
    if action != "drive":
        return act(connect(address, port, cookie), action, arguments)
    while True:
        with contextlib.suppress(Closed, OSError, ValueError, IndexError):
            drive(connect(address, port, cookie), arguments[0], float(arguments[1]))
        time.sleep(RETRY_INTERVAL)


if __name__ == "__main__":
    main(*sys.argv[1:])
