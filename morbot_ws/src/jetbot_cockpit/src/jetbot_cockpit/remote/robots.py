"""The robots of a class, as a hub sees them by one link to each: which there are, what they do, and their stop."""

import asyncio
import itertools
from typing import Any, Callable, Dict, List, Optional, Set

from jetbot_ros.colors import color_of
from jetbot_ros.state import EMERGENCY_STOP

from ..notices import Notice, say
from ..session.messages import FROM_COCKPIT, ROBOT_STATE
from ..session.snapshot import RobotSnapshot, label
from .fleet import Fleet
from .link import Link

WORK_TIMEOUT = 5.0  # s


class RemoteRobots:
    """All robots of a fleet. engaged: whether the emergency stop of all robots is.

    A robot that was out of reach when all were stopped is stopped when it comes back.
    """

    def __init__(self, fleet: Fleet, make_link: Callable[..., Link] = Link):
        self._fleet, self._make_link = fleet, make_link
        self._links: Dict[str, Link] = {}  # by address
        self._rows: Dict[str, dict] = {}   # what each robot has said last, by its id
        self._states: Dict[str, dict] = {}
        self._emergency: Dict[str, bool] = {}  # of those that are connected
        self._works: Dict[str, asyncio.Future] = {}
        self._requests = itertools.count(1)
        self.engaged = False

    def addresses(self) -> Set[str]:
        """Return where robots are, HOST:PORT."""
        return set(self._links)

    def update(self, now: float) -> None:
        """Read the list of robots again, and connect to those that are new."""
        self._fleet.update()
        wanted = {entry.authority for entry in self._fleet.robots}
        for address in self._links.keys() - wanted:
            self._links.pop(address).close()
        for address in wanted - self._links.keys():
            self._links[address] = self._make_link(address, self._fleet, self._receive)
        connected = {f"/{link.robot}" for link in self._links.values() if link.robot}
        for robot in self._emergency.keys() - connected:
            del self._emergency[robot]

    def close(self) -> None:
        """Disconnect all."""
        for link in self._links.values():
            link.close()

    def link(self, robot: Optional[str]) -> Optional[Link]:
        """Return the link to the robot, by its id, or None without a connection."""
        return next((each for each in self._links.values() if each.robot and f"/{each.robot}" == robot), None)

    def send(self, robot: str, message: dict) -> bool:
        """Send a message to a robot; return whether there is a connection."""
        link = self.link(robot)
        return bool(link and link.send(message))

    def stop_all(self) -> None:
        """Stop all robots, each on its own connection, and those that come back."""
        self.engaged = True
        for link in self._links.values():
            link.send({"type": "stop"})

    def release_all(self) -> None:
        """End that."""
        self.engaged = False
        for link in self._links.values():
            link.send({"type": "release"})

    def rows(self) -> List[dict]:
        """Return the robots of the message "robots"."""
        names = {entry.name for entry in self._fleet.robots} | {row.strip("/") for row in self._rows}
        return [self._rows.get(f"/{name}") or absent_row(name) for name in sorted(names)]

    def state(self, page) -> dict:
        """Return the message "state" for a page (hub.HubPage): who drives a robot from there is that page."""
        states = {}
        for row in self.rows():
            robot = row["id"]
            link, own = self.link(robot), page.link(robot)
            state = self._states.get(robot) if link else None
            states[robot] = with_driver(state, own, page.client.id) if state else absent_state(robot)
            if link and self._emergency.get(robot) and not self.engaged:
                states[robot]["stopped"] = True
        return {"type": "state", "emergency": self.engaged, "pupils_release": False, "unconfirmed": self.unconfirmed(),
                "robots": states}

    def unconfirmed(self) -> List[str]:
        """Return which robots have not said that the emergency stop of all robots, which is engaged, holds them."""
        held = {robot for robot, state in self._states.items() if self.link(robot) and EMERGENCY_STOP in state["holds"]}
        return [row["id"] for row in self.rows() if self.engaged and row["id"] not in held]

    async def work(self, fields: Dict[str, Any]) -> tuple:
        """Ask the cockpit of a robot for what it keeps; return an HTTP status and the answer."""
        robot = fields.get("robot")
        request, done = str(next(self._requests)), asyncio.get_event_loop().create_future()
        self._works[request] = done
        try:
            if not self.send(robot, {"type": "work", "request": request, "body": fields}):
                return 409, no_answer(robot).fields()
            return await asyncio.wait_for(done, WORK_TIMEOUT)
        except asyncio.TimeoutError:
            return 409, no_answer(robot).fields()
        finally:
            del self._works[request]

    def _receive(self, link: Link, message: Any) -> None:
        if not isinstance(message, dict):
            return
        kind, robot = message.get("type"), f"/{link.robot}"
        if kind == "robots" and FROM_COCKPIT["robots"].fields["robots"].accepts(message.get("robots")):
            self._rows.update((row["id"], row) for row in message["robots"] if row["id"] == robot)
        elif kind == "state":
            self._on_state(link, robot, message)
        elif kind == "work" and message.get("request") in self._works:
            done = self._works[message["request"]]
            if not done.done():
                done.set_result((message["status"], message["body"]))

    def _on_state(self, link, robot, message):
        state = message["robots"].get(robot)
        if state is not None and ROBOT_STATE.accepts(state):
            self._states[robot] = state
        came_back, before = robot not in self._emergency, self._emergency.get(robot)
        self._emergency[robot] = message["emergency"] is True
        if self.engaged and came_back and not self._emergency[robot]:
            link.send({"type": "stop"})
        elif self.engaged and before and not self._emergency[robot]:
            self.engaged = False  # somebody else has released it


def no_answer(robot: Optional[str]) -> Notice:
    """Return that this robot is out of reach."""
    return say("no_answer", robot=label(robot or ""))


def with_driver(state: dict, own: Optional[Link], page: int) -> dict:
    """Return a robot's state for a page, which has an id of its own there."""
    driver = state["driver"]
    if driver:
        driver = {**driver, "id": page if own and own.client == driver["id"] else 0}
    return {**state, "driver": driver}


def absent_row(name: str) -> dict:
    """Return the row of a robot that was not heard of yet."""
    color = "#" + "".join(f"{round(255 * part):02x}" for part in color_of(name))
    return RobotSnapshot(f"/{name}", color=color).description()


def absent_state(robot: str) -> dict:
    """Return the state of a robot that is out of reach."""
    snapshot = RobotSnapshot(robot, answers=False)
    return snapshot.message(None, None, None, None, 0, None, 0)
