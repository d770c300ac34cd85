"""A class's robots and their links, which a test connects and cuts by hand: no network and no clock.

PYTEST_DONT_REWRITE: test modules import it before they name it as a plugin.
"""

import json
import math
import time

from jetbot_cockpit.notices import say
from jetbot_cockpit.remote.fleet import Entry, Fleet
from jetbot_cockpit.session.snapshot import RobotSnapshot
from jetbot_ros.state import EMERGENCY_STOP, RobotState


class FakeRobot:
    """A cockpit, and whether the emergency stop of all, which is that of this robot alone here, is engaged."""

    def __init__(self, name, instance="1"):
        self.name, self.instance, self.stopped, self.commands, self.works = name, instance, False, [], []

    def state(self):
        state = RobotState("stopped", "stopped", holds=(EMERGENCY_STOP,)) if self.stopped else RobotState("driving")
        row = RobotSnapshot(f"/{self.name}", state=state).message(None, None, None, None, 0, None, 0)
        return {"type": "state", "emergency": self.stopped, "pupils_release": False, "unconfirmed": [],
                "robots": {f"/{self.name}": row}}

    def take(self, message):
        kind = message["type"]
        if kind in ("stop", "release") and message.get("robot") is None:
            self.stopped = kind == "stop"
        self.commands.append(message)


class FakeLink:
    """Stands for remote.link.Link.

    frozen: what is sent stays in the connection, and nothing comes; backlogged, stale: one of the two alone.
    """

    made = []

    def __init__(self, address, fleet, receive, accept=lambda link: True, frames=True):
        self.address, self._receive, self._accept, self.frames = address, receive, accept, frames
        self.robot, self.instance, self.version, self.client, self.delay, self.problem = "", "", "", 0, None, None
        self.frozen = self.backlogged = self.stale = self.closed = False
        self.peer, self.reconnects, self.answered, self._pinged_at = None, 0, -math.inf, -math.inf
        self.made.append(self)

    def connect(self, peer):
        """The robot has proven its name."""
        self.peer, self.robot, self.instance, self.frozen = peer, peer.name, peer.instance, False
        self.backlogged = self.stale = False
        self.problem = None
        if not self._accept(self):
            self.drop(self.problem)
        return bool(self.robot)

    def drop(self, problem=None):
        self.answered = self._pinged_at = -math.inf
        self.peer, self.robot, self.problem = None, "", problem or say("no_link", address=self.address)

    def reconnect(self):
        self.reconnects += 1
        self.drop()

    def close(self):
        self.closed = True
        self.drop()

    def send(self, message):
        if self.robot and not (self.frozen or self.backlogged):
            self.peer.take(message if isinstance(message, dict) else json.loads(message))
        return bool(self.robot)

    def ping(self):
        if not self.frozen:
            self._pinged_at = time.monotonic()

    def is_fresh(self, now):
        return bool(self.robot) and not (self.frozen or self.stale)

    def is_backlogged(self):
        return not self.robot or self.frozen or self.backlogged

    def report(self):
        """The robot answers the pings, and says what it does."""
        if self.robot and not self.frozen:
            self.answered = self._pinged_at
            self.say(self.peer.state())

    def say(self, message):
        self._receive(self, message)


def make_fleet(folder, *names):
    """Return a class's fleet with these robots."""
    fleet = Fleet(str(folder), "7b")
    fleet.save([Entry(name, f"{name}.test") for name in names])
    return fleet


def later():
    """Return a time at which a stop should have been confirmed."""
    return time.monotonic() + 1.0
