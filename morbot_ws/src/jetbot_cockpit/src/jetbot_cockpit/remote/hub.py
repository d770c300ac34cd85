"""The pages of a hub: what they ask for goes to the robots' cockpits, and what those say comes back as one class.

A hub decides nothing: who drives, who is stopped and what is kept is known at each robot. It only keeps for those that
are away that all are stopped, and whether pupils see the cameras. So a hub may be killed, and there may be several. A
page has a link of its own to each robot, and is there what it is here: a person, with leases of its own, whose robot
stops when the page is gone. Times are monotonic seconds.
"""

import itertools
import json
import math
from collections import deque
from typing import Any, Callable, Deque, Dict, List, Optional, Set, Union

from ..notices import say
from ..session import protocol
from ..session.messages import LIMITS
from ..session.protocol import ENDED, FLOODED, FULL, INVALID, LOG_IN, NO_CODE, SILENT, dumps, notice
from ..session.rights import TEACHER, Client
from ..session.viewers import STILL_INTERVAL, PageOwner, Viewer
from . import claims
from .fleet import Fleet
from .link import Link
from .requests import Requests
from .robots import RemoteRobots, absent_state, no_answer
from .tables import Tables

MAX_PAGES = 20
MAX_LOG = 100
GONE_AFTER = 15.0   # s without a sign of life: the socket is closed
STALL = 0.3         # s without a tick: this process was frozen, and commands have waited in the sockets


class HubPage(Viewer):
    """A page, and its links to the robots, by their addresses. changes: what is to be sent with the next frame."""

    def __init__(self, client: Client, owner: PageOwner, connection, now: float):
        super().__init__(client, owner, connection, now)
        self.links: Dict[str, Link] = {}
        self.changes: List[Union[str, bytes]] = []
        self.follows: Dict[str, Optional[str]] = {"look": None, "curves": None}  # a robot, by message
        self.must_lift: Set[str] = set()  # robots that were refused: the finger lifts before it drives them again
        self.codes: Dict[str, List[dict]] = {}  # by robot

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

    make_link: makes a Link; found: see RemoteRobots; log: sentences for the terminal.
    """

    def __init__(self, fleet: Fleet, codes, make_link: Callable[..., Link] = Link, found: Callable[[], Set[str]] = set):
        self._fleet, self._codes, self._make_link = fleet, codes, make_link
        self._robots = RemoteRobots(fleet, self._on_message, make_link, found)
        self._requests, self._tables = Requests(self._robots, fleet.id), Tables()
        self.log: Deque[str] = deque(maxlen=MAX_LOG)
        self._numbers = itertools.count(1)
        self._pages: Dict[int, HubPage] = {}
        self._ticked_at, self._stale_until = math.inf, -math.inf

    # What web.server and web.handlers call

    def join(self, connection, role: str, robot: Optional[str], owner: PageOwner, now: float) -> Optional[HubPage]:
        """Return the new client; None if there is no room, or if it is no teacher: pupils go to their robots."""
        if role != TEACHER:
            connection.close(LOG_IN, NO_CODE)
            return None
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
        states, changes = self._robots.states(), self._tables.take_changes()
        for problem in self._robots.take_problems():
            changes.append(notice(problem))
            self.log.append(str(problem))
        texts = list(map(dumps, changes))
        for page in list(self._pages.values()):
            page.changes.extend(texts if page.robots else ())
            self._show(page, robots, states, now)

    def send_pictures(self, now: float) -> bool:
        """Return that no robot is looked at here: what cameras see comes by a page's own links."""
        return False

    async def answer(self, client: Client, fields: Dict[str, Any]) -> tuple:
        """Answer what is asked of kept programs, as web.work.Works."""
        return await self._requests.answer(fields)

    # How it does that

    def _end(self, page, code, reason):
        self.leave(page)
        page.connection.close(code, reason)

    def _is_stale(self, now):
        if now - self._ticked_at >= STALL:
            self._stale_until = now + STALL
        return now < self._stale_until

    def _on_message(self, robot, message):
        """Take what a robot says besides what it does."""
        if message["type"] == "work":
            self._requests.take(robot, message)
        else:
            self._tables.update(robot, message)

    def _connect(self, page):
        """Give the page a link to each robot: not before its emergency stop was sent, if one is engaged."""
        links = {link.address for link in self._robots.connected().values()}
        for address in page.links.keys() - links:
            page.links.pop(address).close()
        for address in links - page.links.keys():
            page.links[address] = self._make_link(
                address, self._fleet, lambda link, message: self._receive(page, link, message), frames=False)

    def _show(self, page, robots, states, now):
        if now - page.active_at > GONE_AFTER:
            self._end(page, SILENT, "no sign of life")
            return
        if page.is_ready(now):
            self._connect(page)
            changes, page.changes = page.changes, []
            page.show(robots, changes, self._state(page, states), self._tables.messages, now)
        elif page.links:  # it misses something, and gets all again; what it drives stops
            page.close_links()
            page.changes, page.robots = [], ""
        if now - page.pinged_at >= STILL_INTERVAL:
            page.pinged_at = now
            page.connection.ping()

    def _state(self, page, states):
        """Return the message "state" for a page, which has an id of its own at each robot."""
        shown = {robot: seen_from(page, robot, state) for robot, state in states.items()}
        return json.dumps({"type": "state", "emergency": self._robots.emergency, "pupils_release": False,
                           "unconfirmed": self._robots.unconfirmed(), "robots": shown}, separators=(",", ":"))

    def _stop(self, page, robot):
        if robot is None:
            self._robots.stop_all()
        elif not self._robots.stop(robot):
            page.answer(notice(no_answer(robot)))

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
        drives = message.type in ("drive", "program")
        if message.moves:
            refusal = self._refusal(page, message.robot, link, now)
        else:
            refusal = None if link else no_answer(message.robot)
            page.must_lift -= {message.robot} if message.type == "drive" else set()
        if refusal and drives and (message.moves or message.type == "program"):
            page.answer({"type": "lift", "robot": message.robot, **refusal.fields()})
        elif refusal and not drives:
            page.answer(notice(refusal))
        elif link:
            link.send(text)

    def _refusal(self, page, robot, link, now):
        """Return why a command is not passed on, or None: it would come late, or move a robot that must stand."""
        refusal = say("let_go") if robot in page.must_lift else None
        if self._is_stale(now):
            refusal = say("interrupted")
        elif self._robots.engaged:
            refusal = say("all_stopped")
        elif not link or not link.is_fresh(now) or link.is_backlogged():
            refusal = no_answer(robot)
        if refusal:
            page.must_lift.add(robot)
        return refusal

    def _to_all(self, page, message, text, now):
        for link in page.links.values():
            if link.robot:  # else it would come before the proof
                link.send(text)

    def _cameras(self, page, message, text, now):
        self._robots.switch_cameras(message.on)

    def _to_one_or_all(self, page, message, text, now):
        if message.robot is None:
            self._to_all(page, message, text, now)
        else:
            self._to_robot(page, message, text, now)

    def _release(self, page, message, text, now):
        if message.robot is None:
            self._robots.release_all()
        elif not self._robots.release(message.robot):
            page.answer(notice(no_answer(message.robot)))

    def _ping(self, page, message, text, now):
        page.answer({"type": "pong", "sent": message.sent})

    def _follow(self, page, message, text, now):
        before, page.follows[message.type] = page.link(page.follows[message.type]), message.robot
        if before and page.link(message.robot) is not before:
            before.send(ENDS[message.type])
        if message.robot is not None:
            self._to_robot(page, message, text, now)

    def _seen(self, page, message, text, now):
        link = page.link(page.follows["look"])
        if link:
            link.send(text)

    def _receive(self, page: HubPage, link: Link, message: Union[dict, bytes]) -> None:
        """Take what a robot's cockpit sends to a page."""
        followed = [FOLLOWED[each] for each, robot in page.follows.items() if robot == f"/{link.robot}"]
        if isinstance(message, bytes):
            if "picture" in followed and not page.connection.is_backlogged():
                page.connection.send(message)
        elif message["type"] == "codes":
            page.codes[link.robot] = claims.cards(link.robot, message["codes"], link.host, link.port)
            connected = {each.robot for each in page.links.values()}
            rows = [row for robot in sorted(page.codes.keys() & connected) for row in page.codes[robot]]
            page.answer({"type": "codes", "codes": [*self._codes.rows, *rows]})
        elif message["type"] in SENTENCES:
            page.answer(claims.attributed(link.robot, message))
        elif message["type"] in ANSWERS or message["type"] in followed:
            page.answer(message)


def seen_from(page: HubPage, robot: str, state: dict) -> dict:
    """Return a robot's state for a page, which can only drive it once its own link is there.

    Who drives from this page is the page's client, others have the id 0.
    """
    own, driver = page.link(robot), state["driver"]
    if not own:
        return {**absent_state(robot, no_answer(robot)), "link": state["link"]} if state["answers"] else state
    return {**state, "driver": driver and {**driver, "id": page.client.id if own.client == driver["id"] else 0}}


FOLLOWED = {"look": "picture", "curves": "curves"}
ENDS = {"look": {"type": "look", "robot": None}, "curves": {"type": "curves", "robot": None, "eyes": False}}
SENTENCES, ANSWERS = ("lift", "notice"), ("program", "judge")
ROUTES = {"ping": Hub._ping, "name": Hub._to_all, "offer": Hub._to_all, "cameras": Hub._cameras, "codes": Hub._to_all,
          "look": Hub._follow, "curves": Hub._follow, "seen": Hub._seen, "release": Hub._release,
          "go_on": Hub._to_one_or_all, "reset": Hub._to_one_or_all}
