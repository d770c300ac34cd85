"""Who watches, what each one is sent, and when. Times are monotonic seconds."""

import itertools
import math
from typing import Dict, Optional

from ..cockpit_parameters import MAX_ROBOTS
from ..notices import Notice, say
from . import protocol
from .control import Control
from .feed import interval
from .messages import LIMITS, MAX_RATE
from .protocol import ENDED, FLOODED, FULL, INVALID, LOG_IN, NO_CODE, SILENT, dumps
from .rights import TEACHER, Client, refuse_role
from .snapshot import label
from .viewers import STILL_INTERVAL, PageOwner, Viewer, most_crowding

MAX_CLIENTS = MAX_ROBOTS + 1  # a page for each robot, and a teacher's
NO_ROOM = f"{MAX_CLIENTS} pages are connected already"
TOO_MANY = f"more than {MAX_RATE} messages per second"
STOP_PAUSE = 0.1        # s without frames and commands after a stop of all: first of all, it has to reach the wheels
GONE_AFTER = 15.0       # s without a sign of life: the socket is closed
FLOOD_PAUSE = 2.0       # s until who has sent too much may connect again


class Pages:
    """All clients. codes: what a teacher hands out (web.codes.Codes); cameras: what the robots see
    (robots.camera_topics.Cameras).
    """

    def __init__(self, control: Control, codes, cameras):
        self._control, self._codes, self._cameras = control, codes, cameras
        self._numbers = itertools.count(1)
        self._paused_until = -math.inf
        self._viewers: Dict[int, Viewer] = {}
        self._flooded: Dict[PageOwner, float] = {}  # until when these may not connect

    def join(self, connection, role: str, robot: Optional[str], owner: PageOwner, now: float) -> Optional[Viewer]:
        """Return the new client; None if it may not connect now.

        robot: the only one that a pupil may drive, None: any.
        """
        if now < self._flooded.get(owner, now):
            connection.close(FLOODED, TOO_MANY)
            return None
        number = next(self._numbers)
        viewer = Viewer(Client(number, role, robot), owner, connection, now)
        viewers = [*self._viewers.values(), viewer]
        leaving = most_crowding(viewers) if len(viewers) > MAX_CLIENTS else None
        if leaving:
            self.end(leaving, FULL, NO_ROOM)
        if leaving is viewer:
            return None
        codes = role == TEACHER and bool(self._codes.rows)
        connection.send(dumps({"type": "hello", **viewer.client._asdict(), "name": str(viewer.client.name),
                               "codes": codes, "limits": LIMITS}))
        self._viewers[number] = viewer
        return viewer

    def receive(self, viewer: Viewer, text: object, now: float) -> None:
        """Do what a page asks for. A page that sends too much or something else is disconnected."""
        stop = protocol.as_stop(text)
        if stop:  # before all else
            self._stop(viewer, stop.robot, now)
        if self.record_activity(viewer, now) and not stop:
            self._obey(viewer, text, now)

    def record_activity(self, viewer: Viewer, now: float) -> bool:
        """Record that a browser has sent something; return whether it is connected, and stays so."""
        if viewer.client.id in self._viewers and not viewer.record_activity(now):
            self._flooded = {each: until for each, until in self._flooded.items() if now < until}
            self._flooded[viewer.owner] = now + FLOOD_PAUSE
            self.end(viewer, FLOODED, TOO_MANY)
        return viewer.client.id in self._viewers

    def leave(self, viewer: Viewer) -> None:
        """A client's socket is closed: its robot stops."""
        if self._viewers.pop(viewer.client.id, None):
            self._control.leave(viewer.client.id)

    def end(self, viewer: Viewer, code: int, reason: str) -> None:
        """Stop a client's robot, and close its socket for this reason."""
        self.leave(viewer)
        viewer.connection.close(code, reason)

    def knows(self, robot: Optional[str]) -> bool:
        """Return whether there is this robot."""
        return robot in [each["id"] for each in self._control.robots()]

    def close(self) -> None:
        """Disconnect all clients."""
        for viewer in list(self._viewers.values()):
            self.end(viewer, ENDED, "the cockpit has ended")

    def tick(self, now: float) -> None:
        """Send everybody what has changed; call it every FRAME_INTERVAL."""
        if now < self._paused_until:
            return
        changes = list(map(dumps, self._control.check(now)))
        if not self._viewers:
            return
        state, robots = dumps(self._control.state()), dumps({"type": "robots", "robots": self._control.robots()})
        for viewer in list(self._viewers.values()):
            if now - viewer.active_at > GONE_AFTER:
                self.end(viewer, SILENT, "no sign of life")
            elif viewer.is_ready(now):
                viewer.show(robots, changes, state, self._control.history, now)
                viewer.show_curves(self._control.readings)
                viewer.warn(self._control.problem)
            elif changes:
                viewer.robots = ""  # it misses something, and gets all again
            if now - viewer.pinged_at >= STILL_INTERVAL:
                viewer.pinged_at = now
                viewer.connection.ping()

    def send_pictures(self, now: float) -> bool:
        """Send what is due of the robots' pictures; return whether somebody looks. Call it every PICTURE_INTERVAL."""
        looking = [viewer for viewer in self._viewers.values()
                   if viewer.feed.is_used(now) and not self._control.camera_refusal(viewer.client)]
        self._cameras.watch({viewer.feed.robot for viewer in looking})
        for viewer in looking if now >= self._paused_until else ():
            viewer.show_picture(self._cameras.newest(viewer.feed.robot, now), interval(len(looking)), now)
        return bool(looking)

    def _stop(self, viewer: Viewer, robot: Optional[str], now: float) -> None:
        """Stop robots, whatever else there is to do; after its disconnection, a page does so once."""
        if viewer.is_done:
            return
        reply = self._control.stop(viewer.client, robot)
        viewer.is_done = viewer.client.id not in self._viewers
        if robot is None and now >= self._paused_until + STILL_INTERVAL:  # not for ever, if they never end
            self._paused_until = now + STOP_PAUSE
        viewer.answer(reply)

    def _obey(self, viewer: Viewer, text: object, now: float) -> None:
        try:
            message = protocol.parse(text)
        except protocol.ProtocolError as error:
            self.end(viewer, INVALID, str(error))
            return
        if now >= self._paused_until or not message.moves:
            viewer.answer(self._reply(viewer, message, now))

    def _reply(self, viewer: Viewer, message: protocol.Message, now: float) -> Optional[dict]:
        client = viewer.client
        if message.type == "ping":
            return {"type": "pong", "sent": message.sent}
        if message.type == "seen":
            return viewer.feed.acknowledge(message.number)
        if message.type == "look":
            return self._look(viewer, message.robot)
        if message.type == "curves":
            return viewer.curves.follow(message.robot, message.eyes)
        if message.type not in ("codes", "new_code"):
            return self._control.handle(client, message, now)
        refusal = refuse_role(client, message.type)
        if not refusal and message.type == "new_code":
            refusal = self._renew(message.robot)
        return protocol.notice(refusal) if refusal else {"type": "codes", "codes": self._codes.rows}

    def _renew(self, robot: Optional[str]) -> Optional[Notice]:
        """Replace a code, and disconnect who came in with the old one; return that there is none, or None."""
        code = self._codes.renew(robot)
        for viewer in [each for each in self._viewers.values() if each.owner.code == code]:
            self.end(viewer, LOG_IN, NO_CODE)
        return None if code else say("no_code")

    def _look(self, viewer: Viewer, robot: Optional[str]) -> Optional[dict]:
        known, client, refusal = self.knows(robot), viewer.client, None
        if known:
            refusal = self._control.camera_refusal(client) if client.may_drive(robot) else \
                say("own_camera_only", robot=label(client.robot))
        viewer.feed.look(robot if known and not refusal else None)
        return protocol.notice(refusal) if refusal else None
