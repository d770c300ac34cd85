"""Robots' cockpits with an identity, and a hub, each a server on a free port: no ROS master is needed.

PYTEST_DONT_REWRITE: test modules import it before they name it as a plugin.
"""

import json
from types import SimpleNamespace

import pytest
from tornado.websocket import WebSocketHandler

from cockpit_server import GRANTS, WITHIN, StandIn
from jetbot.wait import wait_until
from jetbot_cockpit.classroom.classroom import Classroom
from jetbot_cockpit.remote.fleet import Entry, Fleet
from jetbot_cockpit.remote.hub import Hub
from jetbot_cockpit.remote.identity import Identity
from jetbot_cockpit.remote.key import HUB, proof
from jetbot_cockpit.session.pages import Pages
from jetbot_cockpit.session.snapshot import RobotSnapshot
from jetbot_cockpit.web.access import Access, dialled
from jetbot_cockpit.web.addresses import listen
from jetbot_cockpit.web.hub_socket import HubSocket
from jetbot_cockpit.web.server import Server
from jetbot_cockpit.web.work import Work, Works
from jetbot_ros.state import EMERGENCY_STOP, RobotState
from web_client import Closed, WebSocket, page_headers, request
from web_client import open_page as open_own_page

CLASS = "7b"


class Control(StandIn):
    """A robot that is stopped by a stop of all, and says so."""

    def __init__(self, robot):
        super().__init__()
        self.robot, self.stopped, self.problem = robot, False, None

    def stop(self, client, robot):
        super().stop(client, robot)
        self.stopped = True

    def handle(self, client, message, now):
        super().handle(client, message, now)
        self.stopped = self.stopped and message.type != "release"

    def robots(self):
        return [RobotSnapshot(self.robot).description()]

    def state(self):
        state = RobotState("stopped", "stopped", holds=(EMERGENCY_STOP,)) if self.stopped else RobotState("driving")
        row = RobotSnapshot(self.robot, state=state).message(None, None, None, None, 0, None, 0)
        return {"type": "state", "emergency": self.stopped, "pupils_release": False, "unconfirmed": [],
                "robots": {self.robot: row}}


class Robot:
    """A robot's cockpit. identity: what it says that it is; instance: which start of it this is; socket: for a hub."""

    def __init__(self, identity, instance="1", socket=HubSocket, port=0):
        sockets = listen(port, lan=False)
        self.port, self.classroom = sockets[0].getsockname()[1], Classroom()
        self.control = Control(f"/{identity.robot}")
        access = Access(self.port, [], GRANTS)
        pages = Pages(self.control, SimpleNamespace(rows=[]), self.control)
        hub = {"access": access, "pages": pages, "identity": identity, "instance": instance, "links": {},
               "works": Works(self.classroom, pages.knows)}
        self.server = Server(sockets, access, pages, [(r"/hub", socket, hub)])
        self.server.start()
        self.address = f"127.0.0.1:{self.port}"

    @property
    def done(self):
        """What it was commanded, by whoever."""
        return [(message.type, message.robot) for _, message in self.control.handled]

    def connect(self, **headers):
        """Return a socket of somebody who may be a hub."""
        return WebSocket(self.port, {"Host": self.address, **headers}, path="/hub")


class Liar(WebSocketHandler):
    """Pretends to be jetbot_01, without its key."""

    def initialize(self, **_):
        pass

    def open(self):
        self.write_message(json.dumps({"type": "challenge", "robot": "jetbot_01", "class": CLASS, "nonce": 32 * "0",
                                       "instance": "1"}))

    def on_message(self, message):
        self.write_message(json.dumps({"type": "proof", "proof": json.loads(message)["proof"]}))  # the hub's own


class Relay(WebSocketHandler):
    """Passes on what a hub and a robot say to each other."""

    @classmethod
    def to(cls, robot):
        return type("Relay", (cls,), {"robot": robot})

    def initialize(self, **_):
        pass

    def open(self):
        self.socket = self.robot.connect()
        self.write_message(self.socket.receive("challenge"))

    def on_message(self, message):
        try:
            self.socket.send(message.encode())
            self.write_message(self.socket.receive())
        except Closed as closed:
            self.close(closed.code, closed.reason)


class TeachersHub:
    """A hub's server with these robots of its list, by their addresses."""

    def __init__(self, folder, addresses):
        self.fleet = Fleet(str(folder), CLASS)
        self.fleet.save([Entry(name, address) for name, address in addresses.items()])
        sockets = listen(0, lan=False)
        self.port = sockets[0].getsockname()[1]
        access = Access(self.port, [], [])
        self.hub = Hub(self.fleet, SimpleNamespace(rows=[]))
        self.server = Server(sockets, access, self.hub, [(r"/work", Work, {"access": access, "works": self.hub})])
        self.server.start()

    def page(self):
        return open_own_page(self.port)

    def work(self, **fields):
        """Return the status and the answer to what a page asks of the programs."""
        answer = request(self.port, "POST", "/work", page_headers(self.port, Content_Type="application/json"),
                         json.dumps(fields).encode())
        return answer.status, json.loads(answer.body)


def identity(fleet, robot="jetbot_01", key_of=None):
    """Return who a robot is. key_of: whose key it has, by default its own."""
    return Identity(robot, CLASS, fleet.key_of(key_of or robot))


def answer(fleet, socket, robot="jetbot_01", **fields):
    """Return a hub's answer to the challenge on a socket."""
    said = {"type": "answer", "nonce": 32 * "a", "address": dialled(*socket.connection.getpeername()), **fields}
    return {**said, "proof": proof(fleet.key_of(robot), HUB, socket.receive("challenge"), said)}


@pytest.fixture
def fleet(tmp_path):
    return Fleet(str(tmp_path), CLASS)


@pytest.fixture
def make_robot(fleet):
    """A function that returns a robot with this name, or with the identity of another. options: of Robot."""
    servers = []

    def make(name="jetbot_01", who=None, **options):
        robot = Robot(who or identity(fleet, name), **options)
        servers.append(robot.server)
        return robot
    yield make
    for server in servers:
        server.end()


@pytest.fixture
def make_hub(tmp_path):
    """A function that returns a hub with these robots, {name: robot or address}; connected: how many are waited for."""
    servers = []

    def make(robots, connected=0):
        hub = TeachersHub(tmp_path, {name: getattr(robot, "address", robot) for name, robot in robots.items()})
        servers.append(hub.server)
        assert wait_until(lambda: len(hub.hub._robots.connected()) >= connected, WITHIN)
        return hub
    yield make
    for server in servers:
        server.end()


@pytest.fixture
def open_page():
    """A function that returns a page of a hub, once all robots answer."""
    pages = []

    def make(hub):
        pages.append(hub.page())
        pages[-1].receive_until(lambda said: said["type"] == "state"
                                and all(each["answers"] for each in said["robots"].values()))
        return pages[-1]
    yield make
    for page in pages:
        page.close()
