#!/usr/bin/env python3
"""Serves the page of a class of real robots on the teacher's computer. Needs no ROS."""

# ruff: noqa: E402
import argparse
import os
import signal
import sys
import threading
import time
from pathlib import Path
from typing import Optional

for folder in Path(__file__).resolve().parents[2].glob("*/src"):  # no catkin has put it on the path
    sys.path.insert(0, str(folder))

from jetbot import JetbotError
from jetbot_cockpit.classroom.place import FOLDER
from jetbot_cockpit.remote.finding import Finder
from jetbot_cockpit.remote.fleet import Fleet
from jetbot_cockpit.remote.hub import Hub
from jetbot_cockpit.web import addresses
from jetbot_cockpit.web.access import Access
from jetbot_cockpit.web.announcement import Announcement
from jetbot_cockpit.web.codes import Codes
from jetbot_cockpit.web.handout import open_browser
from jetbot_cockpit.web.server import Server
from jetbot_cockpit.web.work import Work
from jetbot_ros.contract import COCKPIT_PORT

POLL_INTERVAL = 0.25  # s


class Program:
    """The page's server, and what the terminal shows. Raise JetbotError if it cannot start.

    opens: the address below the page's that is opened in a browser, or None.
    """

    def __init__(self, fleet: Fleet, port: int, lan: bool, opens: Optional[str] = None):
        sockets = addresses.listen(port, lan, "--port")
        port = sockets[0].getsockname()[1]
        self.opens = opens if opens is None else f"http://localhost:{port}/{opens}"
        self.codes = Codes(fleet, [] if lan else None, addresses.lan_addresses, port, for_pupils=False)
        self.announcement = Announcement(self.codes, port, 0)
        self.access = Access(port, addresses.host_names() if lan else [], self.codes.grants)
        self.hub = Hub(fleet, self.codes, found=Finder(fleet.name, addresses.lan_addresses).found)
        work = {"access": self.access, "works": self.hub}
        self.server = Server(sockets, self.access, self.hub, [(r"/work", Work, work)])

    def run(self) -> None:
        """Serve until a signal."""
        ended = threading.Event()
        for number in signal.SIGINT, signal.SIGTERM:
            signal.signal(number, lambda *_: ended.set())
        self.server.start()
        if self.opens:
            open_browser(self.opens)
        while self.server.is_alive() and not ended.wait(POLL_INTERVAL):
            self.show(time.monotonic())
        self.server.end()

    def show(self, now: float) -> None:
        """Print the addresses, and what is wrong."""
        self.codes.make_cards()
        sys.stdout.reconfigure(errors="replace")  # a terminal may lack the blocks of the QR codes
        print(self.announcement.take(0, now, sys.stdout.isatty()), end="")
        for line in [*self.access.take_log(now), *(self.hub.log.popleft() for _ in range(len(self.hub.log)))]:
            print(line)
        sys.stdout.flush()


def main() -> None:
    parser = argparse.ArgumentParser(prog="./morbot fleet hub", description=__doc__)
    parser.add_argument("--class", dest="name", required=True, help="the class's name")
    parser.add_argument("--classes", default=FOLDER, help="the folder where classes are kept (%(default)s)")
    parser.add_argument("--port", type=int, default=COCKPIT_PORT, help="TCP port of the page (%(default)s)")
    parser.add_argument("--lan", action="store_true", help="other computers may use the page, with a code")
    parser.add_argument("--open", help="what of the page to open in a browser, such as ?codes")
    given = parser.parse_args()
    try:
        Program(Fleet(given.classes, given.name), given.port, given.lan, given.open).run()
    except JetbotError as error:
        sys.exit(str(error))
    os._exit(0)  # a name that is being looked up would delay the end


if __name__ == "__main__":
    main()
