"""Who watches, what each one is sent, and when. No sockets and no clock here: times are monotonic seconds."""

import itertools
import json
from typing import Dict, Optional, Protocol, Sequence

from . import handout, protocol
from .access import Grant
from .client import TEACHER, Client
from .control import Control
from .limits import TokenBucket

MAX_CLIENTS = 64
REFUSED, LOG_IN, FULL, ENDED = 4000, 4001, 4002, 1001  # why a socket is closed
NO_ROOM = f"{MAX_CLIENTS} pages are connected already"
TOO_MANY = f"more than {protocol.MAX_RATE} messages per second"
FRAME_INTERVAL = 0.05   # s between two frames
STILL_INTERVAL = 1.0    # s between two frames while nothing changes, and between two pings
ABSENT_AFTER = 3.0      # s without a sign of life: frames would only queue up
GONE_AFTER = 15.0       # s without a sign of life: the socket is closed


class Connection(Protocol):
    """The socket of a client. ``is_backlogged``: whether something that was sent is still in this process."""

    def send(self, text: str) -> None: ...

    def ping(self) -> None: ...

    def close(self, code: int, reason: str) -> None: ...

    def is_backlogged(self) -> bool: ...


class Viewer:
    """A client with a socket, and what its page shows."""

    def __init__(self, client: Client, connection: Connection, now: float):
        self.client, self.connection = client, connection
        self.bucket = TokenBucket(protocol.MAX_RATE, protocol.MAX_BURST, now)
        self.active_at = self.pinged_at = self.shown_at = now
        self.state = self.robots = ""

    def record_activity(self, now: float) -> bool:
        """Record a sign of life; return whether there are not too many."""
        self.active_at = now
        return self.bucket.take(now)

    def is_ready(self, now: float) -> bool:
        """Return whether the page takes what it is sent; a frozen browser or a bad network does not."""
        return now - self.active_at < ABSENT_AFTER and not self.connection.is_backlogged()

    def show(self, robots: str, history: Sequence[str], changes: Sequence[str], state: str, now: float) -> None:
        """Send what the page does not show yet."""
        for text in changes if self.robots == robots else [robots, *(changes if self.robots else history)]:
            self.connection.send(text)
        self.robots = robots
        if state != self.state or now - self.shown_at >= STILL_INTERVAL:
            self.connection.send(state)
            self.state, self.shown_at = state, now


class Hub:
    """All clients. cards: the codes to hand out."""

    def __init__(self, control: Control, cards: Sequence[handout.Card]):
        self._control, self._cards = control, cards
        self._numbers = itertools.count(1)
        self._viewers: Dict[int, Viewer] = {}

    def join(self, connection: Connection, grant: Grant, now: float) -> Optional[Viewer]:
        """Return the new client; None if there is no room. A teacher gets the place of the pupil who came last."""
        if len(self._viewers) >= MAX_CLIENTS and grant.role == TEACHER:
            pupils = [viewer for viewer in self._viewers.values() if viewer.client.role != TEACHER]
            for viewer in pupils[-1:]:
                self.end(viewer, FULL, NO_ROOM)
        if len(self._viewers) >= MAX_CLIENTS:
            connection.close(FULL, NO_ROOM)
            return None
        number = next(self._numbers)
        client = Client(number, f"{grant.role} {number}", grant.role, grant.robot)
        codes = grant.role == TEACHER and bool(self._cards)
        connection.send(dumps({"type": "hello", **client._asdict(), "codes": codes}))
        self._viewers[number] = Viewer(client, connection, now)
        return self._viewers[number]

    def receive(self, viewer: Viewer, text: object, now: float) -> None:
        """Do what a page asks for. A page that sends too much or something else is disconnected."""
        if viewer.client.id not in self._viewers:
            return  # it was disconnected, but does not know it yet
        within_limit = viewer.record_activity(now)
        try:
            message = protocol.parse(text)
        except protocol.ProtocolError as error:
            self.end(viewer, REFUSED, str(error))
            return
        if within_limit or isinstance(message, protocol.Stop):  # a stop always counts
            self._answer(viewer, message, now)
        if not within_limit:
            self.end(viewer, REFUSED, TOO_MANY)

    def record_activity(self, viewer: Viewer, now: float) -> None:
        """A browser has sent a ping or a pong by itself."""
        if not viewer.record_activity(now):
            self.end(viewer, REFUSED, TOO_MANY)

    def leave(self, viewer: Viewer) -> None:
        """A client's socket is closed: its robot stops."""
        if self._viewers.pop(viewer.client.id, None):
            self._control.leave(viewer.client.id)

    def end(self, viewer: Viewer, code: int, reason: str) -> None:
        """Stop a client's robot, and close its socket for this reason."""
        self.leave(viewer)
        viewer.connection.close(code, reason)

    def close(self) -> None:
        """Disconnect all clients."""
        for viewer in list(self._viewers.values()):
            self.end(viewer, ENDED, "the cockpit has ended")

    def tick(self, now: float) -> None:
        """Send everybody what has changed; call it every FRAME_INTERVAL."""
        changes = list(map(dumps, self._control.check(now)))
        if not self._viewers:
            return
        state, robots = dumps(self._control.state()), dumps({"type": "robots", "robots": self._control.robots()})
        waits = any(not viewer.robots and viewer.is_ready(now) for viewer in self._viewers.values())
        history = list(map(dumps, self._control.history())) if waits else []
        for viewer in list(self._viewers.values()):
            if now - viewer.active_at > GONE_AFTER:
                self.end(viewer, REFUSED, "no sign of life")
            elif viewer.is_ready(now):
                viewer.show(robots, history, changes, state, now)
            elif changes:
                viewer.robots = ""  # it misses something, and gets all again
            self._ping(viewer, now)

    def _ping(self, viewer: Viewer, now: float) -> None:
        if now - viewer.pinged_at >= STILL_INTERVAL:
            viewer.pinged_at = now
            viewer.connection.ping()

    def _answer(self, viewer: Viewer, message: protocol.Message, now: float) -> None:
        reply = self._reply(viewer, message, now)
        if reply and not viewer.connection.is_backlogged():
            viewer.connection.send(dumps(reply))

    def _reply(self, viewer: Viewer, message: protocol.Message, now: float) -> Optional[dict]:
        if isinstance(message, protocol.Ping):
            return {"type": "pong", "sent": message.sent}
        if not isinstance(message, protocol.Codes):
            return self._control.handle(viewer.client, message, now)
        if viewer.client.role != TEACHER:
            return protocol.notice("Only a teacher can see the codes.")
        return handout.message(self._cards)


def dumps(message: dict) -> str:
    """Return a message as it is sent."""
    return json.dumps(message, separators=(",", ":"))
