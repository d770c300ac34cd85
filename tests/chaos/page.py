#!/usr/bin/env python3
"""A page of the cockpit. Arguments: ADDRESS PORT COOKIE, then drive ROBOT SPEED; stop, release or go_on ROBOT ...;
or judge ROBOT.

One that drives does so until it is ended; after a break, its finger lifts and presses again. The others end as soon as
these robots have confirmed; with 1 if the cockpit refuses that.
"""

import os
import sys
import threading
from pathlib import Path
from typing import Sequence

sys.path.append(str(Path(__file__).resolve().parents[1] / "ros"))
from web_client import Page, WebSocket, page_headers  # noqa: E402

RETRY_INTERVAL = (0.5, 0.5)  # s until a page connects again
TASK = "metre"
HOST = "morbot" if "CHAOS_ISOLATED" in os.environ else "localhost"  # by which everybody is the teacher


def connect(address: str, port: str, cookie: str) -> WebSocket:
    return WebSocket(int(port), page_headers(int(port), HOST, cookie), "", address)


def print_lift(sentence: dict) -> None:
    if sentence["type"] == "lift":
        print(sentence["text"], flush=True)


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
    if action == "drive":
        page = Page(lambda: connect(address, port, cookie), [float(arguments[1])], RETRY_INTERVAL, True, print_lift)
        page.press(arguments[0].lstrip("/"))
        threading.Event().wait()
    act(connect(address, port, cookie), action, arguments)


if __name__ == "__main__":
    main(*sys.argv[1:])
