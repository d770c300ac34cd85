#!/usr/bin/env python3
"""Serves the page of a class of real robots on the teacher's computer. Needs no ROS."""

# ruff: noqa: E402
import argparse
import signal
import sys
import threading
from pathlib import Path

for folder in Path(__file__).resolve().parents[2].glob("*/src"):  # no catkin has put it on the path
    sys.path.insert(0, str(folder))

from jetbot import JetbotError
from jetbot_cockpit.classroom.classroom import Classroom
from jetbot_cockpit.remote.fleet import FOLDER, Fleet
from jetbot_cockpit.remote.hub import Hub
from jetbot_cockpit.web import addresses
from jetbot_cockpit.web.access import Access
from jetbot_cockpit.web.codes import Codes
from jetbot_cockpit.web.server import Server
from jetbot_cockpit.web.work import Work
from jetbot_ros.contract import COCKPIT_PORT


def serve(fleet: Fleet, port: int, lan: bool) -> None:
    """Serve until a signal. Raise JetbotError."""
    sockets = addresses.listen(port, lan)
    port = sockets[0].getsockname()[1]
    codes = Codes(Classroom(), [] if lan else None, addresses.lan_addresses, port)
    access = Access(port, addresses.host_names() if lan else [], codes.grants)
    hub = Hub(fleet, codes)
    server = Server(sockets, access, hub, [(r"/work", Work, {"access": access, "works": hub})])
    ended = threading.Event()
    for number in signal.SIGINT, signal.SIGTERM:
        signal.signal(number, lambda *_: ended.set())
    server.start()
    print(f"The class {fleet.name}, for a browser on this computer: http://localhost:{port}/", flush=True)
    while server.is_alive() and not ended.wait(0.25):
        pass
    server.end()


def main() -> None:
    parser = argparse.ArgumentParser(prog="./morbot fleet hub", description=__doc__)
    parser.add_argument("--class", dest="name", required=True, help="the class's name")
    parser.add_argument("--classes", default=FOLDER)
    parser.add_argument("--port", type=int, default=COCKPIT_PORT)
    parser.add_argument("--lan", action="store_true")
    given = parser.parse_args()
    try:
        serve(Fleet(given.classes, given.name), given.port, given.lan)
    except JetbotError as error:
        sys.exit(str(error))


if __name__ == "__main__":
    main()
