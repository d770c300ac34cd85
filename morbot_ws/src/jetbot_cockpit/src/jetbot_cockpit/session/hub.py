"""Who watches, what each one is sent, and when. Times are monotonic seconds."""

import itertools
import json
import logging
import math
from collections import Counter
from typing import Callable, Dict, List, NamedTuple, Optional, Sequence

from ..cockpit_parameters import MAX_ROBOTS
from ..notices import Notice, say
from . import protocol
from .control import Control
from .feed import Feed, Picture, interval
from .messages import LIMITS, MAX_BURST, MAX_RATE, problem_of
from .rights import TEACHER, Client, refuse_role
from .snapshot import label

MAX_CLIENTS = MAX_ROBOTS + 1  # a page for each robot, and a teacher's
MAX_FRAME = 8192  # bytes of a message that is read at all; Tornado closes the socket of a larger one with 1009
REFUSED, LOG_IN, FULL, ENDED = 4000, 4001, 4002, 1001  # why a socket is closed
NO_ROOM = f"{MAX_CLIENTS} pages are connected already"
TOO_MANY = f"more than {MAX_RATE} messages per second"
FRAME_INTERVAL = 0.08   # s between two frames: what the pages draw more often delays a stop
PICTURE_INTERVAL = 0.01  # s between two looks at the cameras, while somebody looks
STOP_PAUSE = 0.1        # s without frames and commands after a stop of all: first of all, it has to reach the wheels
STILL_INTERVAL = 1.0    # s between two frames while nothing changes, and between two pings
ABSENT_AFTER = 3.0      # s without a sign of life: frames would only queue up
GONE_AFTER = 15.0       # s without a sign of life: the socket is closed
FLOOD_PAUSE = 2.0       # s until who has sent too much may connect again


class PageOwner(NamedTuple):
    """Whose pages share places and limits: the label of a code, and an address. One code may be a whole class's."""

    code: str
    address: str


class Viewer:
    """A client with a socket (web.handlers.Socket), and what its page shows."""

    def __init__(self, client: Client, owner: PageOwner, connection, now: float):
        self.client, self.owner, self.connection = client, owner, connection
        self.allowance = float(MAX_BURST)  # messages that it may send now
        self.active_at = self.pinged_at = self.shown_at = now
        self.state = self.robots = ""
        self.problem: Optional[Notice] = None
        self.is_done = False  # it was disconnected, and has stopped since: nothing more of it counts
        self.feed = Feed()

    def record_activity(self, now: float) -> bool:
        """Record a sign of life; return whether there are not too many: MAX_RATE, after a pause MAX_BURST at once."""
        refilled = self.allowance + (now - self.active_at) * MAX_RATE
        self.allowance = min(MAX_BURST, refilled) - 1
        self.active_at = now
        return self.allowance >= 0

    def show_picture(self, picture: Optional[Picture], pause: float, now: float) -> None:
        """Send a part of the newest picture, if it is due. What acknowledges it is within the limit of messages."""
        for message in [] if self.connection.is_backlogged() else self.feed.next(picture, pause, now):
            self.connection.send(message if isinstance(message, bytes) else dumps(message))
            self.allowance += isinstance(message, bytes)

    def is_ready(self, now: float) -> bool:
        """Return whether the page takes what it is sent; a frozen browser or a bad network does not."""
        return now - self.active_at < ABSENT_AFTER and not self.connection.is_backlogged()

    def show(self, robots: str, changes: List[str], state: str, history: Callable[[], List[dict]], now: float) -> None:
        """Send what the page does not show yet. history: returns what only a new page needs."""
        texts = changes if self.robots else list(map(dumps, history()))
        for text in texts if self.robots == robots else [robots, *texts]:
            self.connection.send(text)
        self.robots = robots
        if state != self.state or now - self.shown_at >= STILL_INTERVAL:
            self.connection.send(state)
            self.state, self.shown_at = state, now

    def warn(self, problem: Optional[Notice]) -> None:
        """Tell a teacher once why the class is not kept, and when it is again: None."""
        if problem != self.problem and self.client.role == TEACHER:
            self.connection.send(dumps(protocol.notice(problem or say("class_kept_again"))))
        self.problem = problem


class Hub:
    """All clients. codes: the rows of the message "codes", with what a teacher hands out; cameras: what the robots see
    (robots.cameras.Cameras).
    """

    def __init__(self, control: Control, codes: Sequence[dict], cameras):
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
            connection.close(REFUSED, TOO_MANY)
            return None
        number = next(self._numbers)
        viewer = Viewer(Client(number, f"{role} {number}", role, robot), owner, connection, now)
        viewers = [*self._viewers.values(), viewer]
        leaving = most_crowding(viewers) if len(viewers) > MAX_CLIENTS else None
        if leaving:
            self.end(leaving, FULL, NO_ROOM)
        if leaving is viewer:
            return None
        codes = role == TEACHER and bool(self._codes)
        connection.send(dumps({"type": "hello", **viewer.client._asdict(), "codes": codes, "limits": LIMITS}))
        self._viewers[number] = viewer
        return viewer

    def receive(self, viewer: Viewer, text: object, now: float) -> None:
        """Do what a page asks for. A page that sends too much or something else is disconnected."""
        stop = protocol.as_stop(text)
        if stop and not viewer.is_done:  # before all else, also from a page that was just disconnected
            self._stop(viewer, stop, now)
        if self.record_activity(viewer, now) and not stop:
            self._obey(viewer, text, now)

    def record_activity(self, viewer: Viewer, now: float) -> bool:
        """Record that a browser has sent something; return whether it is connected, and stays so."""
        if viewer.client.id in self._viewers and not viewer.record_activity(now):
            self._flooded = {each: until for each, until in self._flooded.items() if now < until}
            self._flooded[viewer.owner] = now + FLOOD_PAUSE
            self.end(viewer, REFUSED, TOO_MANY)
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
                self.end(viewer, REFUSED, "no sign of life")
            elif viewer.is_ready(now):
                viewer.show(robots, changes, state, self._control.history, now)
                viewer.warn(self._control.problem)
            elif changes:
                viewer.robots = ""  # it misses something, and gets all again
            if now - viewer.pinged_at >= STILL_INTERVAL:
                viewer.pinged_at = now
                viewer.connection.ping()

    def send_pictures(self, now: float) -> bool:
        """Send what is due of the robots' pictures; return whether somebody looks. Call it every PICTURE_INTERVAL."""
        looking = [viewer for viewer in self._viewers.values() if viewer.feed.is_used(now)]
        self._cameras.watch({viewer.feed.robot for viewer in looking})
        for viewer in looking if now >= self._paused_until else ():
            viewer.show_picture(self._cameras.newest(viewer.feed.robot, now), interval(len(looking)), now)
        return bool(looking)

    def _stop(self, viewer: Viewer, stop: protocol.Message, now: float) -> None:
        self._answer(viewer, stop, now)
        if viewer.client.id not in self._viewers:
            self._control.leave(viewer.client.id)
            viewer.is_done = True
        if stop.robot is None and now >= self._paused_until + STILL_INTERVAL:  # not for ever, if they never end
            self._paused_until = now + STOP_PAUSE

    def _obey(self, viewer: Viewer, text: object, now: float) -> None:
        try:
            message = protocol.parse(text)
        except protocol.ProtocolError as error:
            self.end(viewer, REFUSED, str(error))
            return
        if now >= self._paused_until or not (message.forward or message.left):
            self._answer(viewer, message, now)

    def _answer(self, viewer: Viewer, message: protocol.Message, now: float) -> None:
        reply = self._reply(viewer, message, now)
        if reply and not viewer.connection.is_backlogged():
            viewer.connection.send(dumps(reply))

    def _reply(self, viewer: Viewer, message: protocol.Message, now: float) -> Optional[dict]:
        client = viewer.client
        if message.type == "ping":
            return {"type": "pong", "sent": message.sent}
        if message.type == "seen":
            return viewer.feed.acknowledge(message.number)
        if message.type == "look":
            return self._look(viewer, message.robot)
        if message.type != "codes":
            return self._control.handle(client, message, now)
        refusal = refuse_role(client, message.type)
        return protocol.notice(refusal) if refusal else {"type": "codes", "codes": self._codes}

    def _look(self, viewer: Viewer, robot: Optional[str]) -> Optional[dict]:
        known = self.knows(robot)
        allowed = known and viewer.client.may_drive(robot)
        viewer.feed.look(robot if allowed else None)
        return protocol.notice(say("own_camera_only", robot=label(viewer.client.robot))) \
            if known and not allowed else None


def most_crowding(viewers: Sequence[Viewer]) -> Viewer:
    """Return who leaves when there is no room: the newest page of the code that has the most pages.

    If one code has them at several addresses: at the address that has the most. A teacher's goes last.
    """
    codes, owners = (Counter(each) for each in zip(*((viewer.owner.code, viewer.owner) for viewer in viewers)))
    return max(viewers, key=lambda viewer: (codes[viewer.owner.code], owners[viewer.owner],
                                            viewer.client.role != TEACHER, viewer.client.id))


def dumps(message: dict) -> str:
    """Return a message as it is sent; one that is not as documented is logged, for a page can do without a field."""
    problem = problem_of(message)
    if problem:
        logging.getLogger(__name__).error("A message is not as documented: %s", problem)
    return json.dumps(message, separators=(",", ":"))
