"""A cockpit's server on a free port, with a stand-in for the control: no ROS master is needed.

PYTEST_DONT_REWRITE: test modules import it before they name it as a plugin.
"""

import functools
import json
import time
from types import SimpleNamespace

import pytest

from jetbot_cockpit.classroom.classroom import Classroom
from jetbot_cockpit.robots.recording import Recording
from jetbot_cockpit.session.pages import Pages
from jetbot_cockpit.session.protocol import Message
from jetbot_cockpit.session.snapshot import RobotSnapshot
from jetbot_cockpit.web import server as servers
from jetbot_cockpit.web.access import Access, make_grants, numbered
from jetbot_cockpit.web.addresses import listen
from jetbot_cockpit.web.handout import Card
from jetbot_cockpit.web.page_files import read_files
from jetbot_cockpit.web.server import Server
from jetbot_cockpit.web.work import Work, Works
from jetbot_ros.state import RobotState
from web_client import WebSocket, page_headers, request

WITHIN = 10.0  # s, less than session.pages.GONE_AFTER
GRANTS = make_grants(numbered(2))
TEACHER, FIRST_PUPIL, _ = GRANTS
PING = {"type": "ping", "sent": 1}
STOP = {"type": "stop"}
DRIVE = {"type": "drive", "robot": "/", "forward": 1, "left": 0}
servers.read_files = functools.lru_cache(maxsize=None)(read_files)  # the page's, once for all servers of the tests


class StandIn:
    """A control that notes what it is asked for. state_size: characters of a status, which changes all the time.

    It stands in for the cameras, too. picture: the newest one of the robot "/".
    """

    def __init__(self):
        self.handled, self.left, self.state_size, self.picture, self.problem = [], [], 1, None, ""
        self.recording = Recording()

    def handle(self, client, message, now):
        self.handled.append((client, message))

    def stop(self, client, robot):
        self.handled.append((client, Message("stop", robot)))

    def leave(self, client):
        self.left.append(client)

    def check(self, now):
        return []

    def robots(self):
        return [RobotSnapshot("/").description()]

    def watch(self, robots):
        pass

    def newest(self, robot, now):
        return self.picture

    def history(self):
        return []

    def readings(self, robot, since, eyes):
        return 1000.0, self.recording.since(since)

    def state(self):
        driving = RobotState("driving", f"{time.monotonic()} {'x' * self.state_size}")
        robot = RobotSnapshot("/", state=driving).message(None, None, None, None, 0, None, 0)
        return {"type": "state", "emergency": False, "pupils_release": False, "unconfirmed": [],
                "robots": {"/": robot}}


class Cockpit:
    """A server on a free port, and what its pages send."""

    def __init__(self):
        sockets = listen(0, lan=False)
        self.port = sockets[0].getsockname()[1]
        self.access = Access(self.port, ["class.test"], GRANTS)
        self.control, self.classroom = StandIn(), Classroom()
        codes = SimpleNamespace(rows=[Card(grant, "class.test", self.port).message() for grant in GRANTS])
        pages = Pages(self.control, codes, self.control)
        self.server = Server(sockets, self.access, pages, [
            (r"/work", Work, {"access": self.access, "works": Works(self.classroom, pages.knows)})])
        self.server.start()

    def headers(self, name="localhost", **headers):
        return page_headers(self.port, name, **headers)

    def log_in(self, code, phone="127.0.0.1", **headers):
        """Send a code from this address; return the answer."""
        headers = {"Content_Type": "application/json", **headers}
        return request(self.port, "POST", "/login", self.headers("class.test", **headers),
                       json.dumps({"code": code}).encode(), phone)

    def cookie(self, grant):
        return self.log_in(grant.code).headers["set-cookie"].partition(";")[0]

    def page(self, name="localhost", phone="127.0.0.1", **headers):
        """Return a new page's socket, from this address."""
        return WebSocket(self.port, self.headers(name, **headers), phone)


@pytest.fixture(scope="module")
def cockpit():
    cockpit = Cockpit()
    yield cockpit
    cockpit.server.end()


@pytest.fixture
def fresh():
    """A cockpit whose wrong codes and clients are this test's own."""
    cockpit = Cockpit()
    yield cockpit
    cockpit.server.end()
