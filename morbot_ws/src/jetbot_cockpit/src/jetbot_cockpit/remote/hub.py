"""The pages of a hub: what they ask for goes to the robots' cockpits, and what those say comes back as one class.

A hub decides nothing: who drives, who is stopped and what is kept is known at each robot. So a hub may be killed, and
there may be several. A page has a link of its own to each robot, and is there what it is here: a person, with leases of
its own, whose robot stops when the page is gone. Times are monotonic seconds.
"""

import itertools
import json
import math
from typing import Any, Callable, Dict, List, Optional, Union

from ..notices import say
from ..session import protocol
from ..session.messages import LIMITS
from ..session.protocol import ENDED, FLOODED, FULL, INVALID, SILENT, dumps, notice
from ..session.rights import TEACHER, Client
from ..session.viewers import STILL_INTERVAL, PageOwner, Viewer
from .fleet import Fleet
from .link import Link
from .robots import RemoteRobots, no_answer

MAX_PAGES = 20
GONE_AFTER = 15.0   # s without a sign of life: the socket is closed
STALL = 0.3         # s without a tick: this process was frozen, and commands have waited in the sockets


class HubPage(Viewer):
    """A page, and its links to the robots, by their addresses. changes: what is to be sent with the next frame."""

    def __init__(self, client: Client, owner: PageOwner, connection, now: float):
        super().__init__(client, owner, connection, now)
        self.links: Dict[str, Link] = {}
        self.changes: List[Union[str, bytes]] = []
        self.looks_at: Optional[str] = None
        self.codes: Dict[str, List[dict]] = {}  # by robot
        self.cameras: Dict[str, bool] = {}      # whether its pupils see them

    def link(self, robot: Optional[str]) -> Optional[Link]:
        """Return the link to the robot, by its id, or None without a connection."""
        return next((each for each in self.links.values() if each.robot and f"/{each.robot}" == robot), None)

    def close_links(self) -> None:
        """End what drives robots from here: each stops."""
        for link in self.links.values():
            link.close()
        self.links = {}


class Hub:
    """All pages, and the robots. codes: what a teacher hands out for this hub (web.codes.Codes).

    make_link: makes a Link.
    """

    def __init__(self, fleet: Fleet, codes, make_link: Callable[..., Link] = Link):
        self._fleet, self._codes, self._make_link = fleet, codes, make_link
        self._robots = RemoteRobots(fleet, make_link)
        self._numbers = itertools.count(1)
        self._pages: Dict[int, HubPage] = {}
        self._ticked_at, self._stale_until = math.inf, -math.inf

    # What web.server and web.handlers call

    def join(self, connection, role: str, robot: Optional[str], owner: PageOwner, now: float) -> Optional[HubPage]:
        """Return the new client, a teacher; None if there is no room."""
        if len(self._pages) >= MAX_PAGES:
            connection.close(FULL, f"{MAX_PAGES} pages are connected already")
            return None
        number = next(self._numbers)
        page = self._pages[number] = HubPage(Client(number, TEACHER), owner, connection, now)
        connection.send(dumps({"type": "hello", **page.client._asdict(), "name": str(page.client.name), "codes": True,
                               "limits": LIMITS}))
        return page

    def receive(self, page: HubPage, text: object, now: float) -> None:
        """Do what a page asks for. A page that sends too much or something else is disconnected."""
        stop = protocol.as_stop(text)
        if stop:  # before all else
            self._stop(page, stop.robot)
        if self.record_activity(page, now) and not stop:
            self._obey(page, text, now)

    def record_activity(self, page: HubPage, now: float) -> bool:
        """Record that a browser has sent something; return whether it is connected, and stays so."""
        if page.client.id in self._pages and not page.record_activity(now):
            self._end(page, FLOODED, "too many messages")
        return page.client.id in self._pages

    def leave(self, page: HubPage) -> None:
        """A page's socket is closed: its robot stops."""
        if self._pages.pop(page.client.id, None):
            page.close_links()

    def close(self) -> None:
        """Disconnect all pages and robots."""
        for page in list(self._pages.values()):
            self._end(page, ENDED, "the hub has ended")
        self._robots.close()

    def tick(self, now: float) -> None:
        """Send everybody what has changed; call it every FRAME_INTERVAL."""
        self._is_stale(now)
        self._ticked_at = now
        self._robots.update(now)
        robots = dumps({"type": "robots", "robots": self._robots.rows()})
        for page in list(self._pages.values()):
            self._show(page, robots, now)

    def send_pictures(self, now: float) -> bool:
        """Return that no robot is looked at here: what cameras see comes by a page's own links."""
        return False

    async def answer(self, client: Client, fields: Dict[str, Any]) -> tuple:
        """Answer what is asked of kept programs, as web.work.Works."""
        return await self._robots.work(fields)

    # How it does that

    def _end(self, page, code, reason):
        self.leave(page)
        page.connection.close(code, reason)

    def _is_stale(self, now):
        if now - self._ticked_at >= STALL:
            self._stale_until = now + STALL
        return now < self._stale_until

    def _show(self, page, robots, now):
        if now - page.active_at > GONE_AFTER:
            self._end(page, SILENT, "no sign of life")
            return
        if page.is_ready(now):
            for address in self._robots.addresses() - page.links.keys():
                page.links[address] = self._make_link(address, self._fleet,
                                                      lambda link, message: self._receive(page, link, message))
            for address in page.links.keys() - self._robots.addresses():
                page.links.pop(address).close()
            changes, page.changes = page.changes, []
            page.show(robots, changes, dumps(self._robots.state(page)), lambda: changes, now)
        elif page.links:  # it misses something, and gets all again; what it drives stops
            page.close_links()
            page.changes, page.robots = [], ""
        if now - page.pinged_at >= STILL_INTERVAL:
            page.pinged_at = now
            page.connection.ping()

    def _stop(self, page, robot):
        if robot is None:
            self._robots.stop_all()
        else:
            self._robots.send(robot, {"type": "stop", "robot": robot})

    def _obey(self, page, text, now):
        try:
            message = protocol.parse(text)
        except protocol.ProtocolError as error:
            self._end(page, INVALID, str(error))
            return
        route = ROUTES.get(message.type, Hub._to_robot)
        route(self, page, message, text, now)

    def _to_robot(self, page, message, text, now):
        """Pass a message on to its robot."""
        link = page.link(message.robot)
        if message.moves and (self._is_stale(now) or not link or not link.is_fresh(now) or link.is_backlogged()):
            refusal = say("interrupted") if self._is_stale(now) else no_answer(message.robot)
            page.answer({"type": "lift", "robot": message.robot, **refusal.fields()})
        elif link:
            link.send(text)
        elif message.type not in ("drive", "program"):
            page.answer(notice(no_answer(message.robot)))

    def _to_all(self, page, message, text, now):
        for link in page.links.values():
            link.send(text)

    def _to_one_or_all(self, page, message, text, now):
        if message.robot is None:
            self._to_all(page, message, text, now)
        else:
            self._to_robot(page, message, text, now)

    def _release(self, page, message, text, now):
        if message.robot is None:
            self._robots.release_all()
        else:
            self._robots.send(message.robot, {"type": "release", "robot": message.robot})
            self._robots.send(message.robot, {"type": "release", "robot": None})

    def _ping(self, page, message, text, now):
        page.answer({"type": "pong", "sent": message.sent})

    def _look(self, page, message, text, now):
        before, page.looks_at = page.link(page.looks_at), message.robot
        if before and page.link(message.robot) is not before:
            before.send({"type": "look", "robot": None})
        if message.robot is not None:
            self._to_robot(page, message, text, now)

    def _seen(self, page, message, text, now):
        link = page.link(page.looks_at)
        if link:
            link.send(text)

    def _receive(self, page: HubPage, link: Link, message: Union[dict, bytes]) -> None:
        """Take what a robot's cockpit sends to a page."""
        if isinstance(message, bytes):
            page.connection.send(message)
            return
        kind = message.get("type")
        if kind in ("lift", "program", "judge", "picture", "notice"):
            page.answer(message)
        elif kind in ("trail", "scene"):
            page.changes.append(json.dumps(message))
        elif kind == "cameras":
            page.cameras[link.robot] = message["on"]
            page.answer({"type": "cameras", "on": any(page.cameras.values())})  # one that missed the switch is seen
        elif kind == "codes":
            page.codes[link.robot] = [each for each in message["codes"] if each["role"] != TEACHER]
            rows = [row for robot in sorted(page.codes) for row in page.codes[robot]]
            page.answer({"type": "codes", "codes": [*self._codes.rows, *rows]})


ROUTES = {"ping": Hub._ping, "name": Hub._to_all, "offer": Hub._to_all, "cameras": Hub._to_all, "codes": Hub._to_all,
          "look": Hub._look, "seen": Hub._seen, "release": Hub._release, "go_on": Hub._to_one_or_all,
          "reset": Hub._to_one_or_all}
