#!/usr/bin/env python3
"""ROS node: a web page that drives, watches and stops all robots of a ROS master."""

import jetbot_ros.boot

import math
import secrets
import sys
import time
from typing import List, Optional

import rospy

from jetbot import JetbotError
from jetbot_cockpit.classroom.classroom import Classroom, open_classroom
from jetbot_cockpit.cockpit_parameters import PARAMETERS, resolve
from jetbot_cockpit.remote import identity as identities
from jetbot_cockpit.remote.identity import Identity
from jetbot_cockpit.remote.version import version_of
from jetbot_cockpit.robots.camera_topics import Cameras
from jetbot_cockpit.robots.command_publishers import Drivers
from jetbot_cockpit.robots.discovery import Robots
from jetbot_cockpit.session.collection import Collection
from jetbot_cockpit.session.control import Control
from jetbot_cockpit.session.pages import Pages
from jetbot_cockpit.session.snapshot import Snapshot
from jetbot_cockpit.web import addresses, handout
from jetbot_cockpit.web.access import Access, numbered
from jetbot_cockpit.web.announcement import Announcement
from jetbot_cockpit.web.codes import Codes
from jetbot_cockpit.web.hub_socket import HubSocket
from jetbot_cockpit.web.server import Server
from jetbot_cockpit.web.work import Work, Works
from jetbot_ros import contract, lifecycle
from jetbot_ros.launcher import Launcher
from jetbot_ros.node_parameters import fake_advice, private_parameters

POLL_INTERVAL = 0.25    # s
NO_ROBOT_AFTER = 5.0    # s after the start until the lack of robots is reported
NO_ROBOT = "No robot is running. Start one: roslaunch jetbot_control_node jetbot_controller.launch"
SHUTDOWN_TIMEOUT = 2.0  # s for the end of this node


def routes(access: Access, pages: Pages, classroom: Classroom, identity: Optional[Identity]) -> List[tuple]:
    """Return what is served besides the page: its programs, and for the hub of this robot's class a socket."""
    works = Works(classroom, pages.knows)
    hub = {"access": access, "pages": pages, "identity": identity, "works": works, "instance": secrets.token_hex(8),
           "links": {}}
    return [(r"/work", Work, {"access": access, "works": works}), *([(r"/hub", HubSocket, hub)] if identity else [])]


class Cockpit:
    """The page's server, and what connects it to the robots. Raise JetbotError if it cannot start."""

    def __init__(self):
        lifecycle.init_node(contract.COCKPIT)
        given = resolve(private_parameters(rospy.get_name(), rospy.get_param("~", {}), PARAMETERS))

        # Listen first: a port that is taken ends the node before it does anything
        sockets = addresses.listen(given["port"], given["lan"])
        self.port = sockets[0].getsockname()[1]
        self.browser = given["browser"]

        # Who gets in, and what is handed out: other computers need a code
        identity = identities.read(given["identity"]) if given["identity"] else None
        self.classroom = open_classroom(given["classes"], identity.class_name if identity else given["class"])
        name = [given["name"]] if given["name"] else []
        robots = [identity.robot] if identity else numbered(given["robots"])
        self.codes = Codes(self.classroom, robots if given["lan"] else None,
                           lambda: name or addresses.lan_addresses(), self.port)
        self.access = Access(self.port, [*name, *addresses.host_names()] if given["lan"] else [], self.codes.grants)
        self.announcement = Announcement(self.codes, self.port, given["robots"])

        # What clients ask for goes into the control, and what the robots report comes out
        self.drivers = Drivers()
        cameras = Cameras()
        self.control = Control(Robots(), self.drivers, cameras, Collection(given["pictures"]), self.classroom,
                               version_of())
        pages = Pages(self.control, self.codes, cameras)
        self.server = Server(sockets, self.access, pages, routes(self.access, pages, self.classroom, identity))
        self.logged, self.no_robot_at = Snapshot(), time.monotonic() + NO_ROBOT_AFTER

    def run(self):
        """Serve until a signal, the end of rospy or of roslaunch."""
        ended = lifecycle.ending()
        self.server.start()
        if self.browser == "auto":
            handout.open_browser(f"http://localhost:{self.port}/")
        launcher = Launcher()
        self.show()
        while not ended.wait(POLL_INTERVAL) and not launcher.ended and self.server.is_alive():
            launcher.poll()
            self.log_changes()  # in this thread: a terminal that blocks holds up no client
            self.show()
        self.end()

    def log_changes(self):
        """Log which robots have come, ended or fallen silent since the last call, and from where nobody gets in."""
        now, before, self.logged = time.monotonic(), self.logged, self.control.snapshot
        self.classroom.retry()
        lines = [*self.logged.changes_since(before), *self.access.take_log(now), *self.classroom.take_problems()]
        if self.logged.robots:
            self.no_robot_at = math.inf
        if now > self.no_robot_at:
            self.no_robot_at = math.inf
            lines.append(NO_ROBOT)
        for line in lines:
            rospy.loginfo(line)

    def show(self):
        """Print the addresses when it is time."""
        self.codes.make_cards()
        text = self.announcement.take(len(self.logged.robots), time.monotonic(), sys.stdout.isatty())
        if text:
            # Printed, not logged: neither a log file nor /rosout holds a code
            sys.stdout.reconfigure(errors="replace")  # a terminal may lack the blocks of the QR codes
            print(text, end="", flush=True)

    def end(self):
        """Disconnect the clients, whose robots stop, and leave ROS; within SHUTDOWN_TIMEOUT."""
        lifecycle.leave_within(SHUTDOWN_TIMEOUT)
        self.server.end()
        self.drivers.close()
        rospy.signal_shutdown("the cockpit has ended")


def main():
    try:
        Cockpit().run()
    except JetbotError as error:
        sys.exit(error.text(fake_advice))  # one sentence; not as a fatal error: the robots run on without a page
    lifecycle.leave(0)


if __name__ == "__main__":
    main()
