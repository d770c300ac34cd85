"""The robots of a class, as a hub sees them by one link to each: which there are, what they do, and their stop."""

import contextlib
import math
import time
from typing import Any, Callable, Dict, List, Optional, Set

from jetbot import InvalidValue
from jetbot_ros.colors import web_color_of
from jetbot_ros.state import EMERGENCY_STOP

from ..notices import Notice, say
from ..session.messages import PARTS, ROBOT_ROW, ROBOT_STATE
from ..session.snapshot import RobotSnapshot, label
from .fleet import Fleet
from .link import Link

CONFIRM_TIMEOUT = 0.5  # s in which a robot confirms a stop whose connection works
CAMERAS, STOP = "cameras", "stop"  # what is kept for robots that are away, also by the next hub
REPORTED = "twice", "forged", "relayed", "wrong_key", "too_much"  # problems that somebody must solve


class RemoteRobots:
    """All robots of a fleet. engaged: whether the emergency stop of all robots was engaged here.

    A robot that comes back meanwhile is stopped before all else, also by the next hub, if this one ends. found: returns
    the addresses, HOST:PORT, where robots announce themselves; receive: is called with a robot's id and each message
    that is not about robots and states.
    """

    def __init__(self, fleet: Fleet, receive: Callable[[str, dict], None], make_link: Callable[..., Link] = Link,
                 found: Callable[[], Set[str]] = set):
        self._fleet, self._pass_on, self._make_link, self._found = fleet, receive, make_link, found
        self._links: Dict[str, Link] = {}  # by address
        self._owners: Dict[str, Link] = {}  # which link is a robot's, by its id
        self._rows: Dict[str, dict] = {}   # what each robot has said last, by its id
        self._states: Dict[str, dict] = {}
        self._emergency: Dict[str, bool] = {}  # what each robot says of the stop of all, while it is connected
        self._reported: Dict[str, Notice] = {}  # by address
        self.engaged = fleet.read(STOP, bool)
        self._stopped_at = time.monotonic() if self.engaged else -math.inf
        self._heard_since_stop: Set[str] = set()
        self._cameras: Dict[str, bool] = fleet.read(CAMERAS, dict)  # what a teacher has switched here, or {}

    def update(self, now: float) -> None:
        """Read the list of robots again, and connect to those that are new."""
        with contextlib.suppress(InvalidValue):  # somebody edits the list: the one from before counts
            self._fleet.update()
        for name in self._fleet.removed.keys() - {entry.name for entry in self._fleet.robots}:
            if f"/{name}" in self._owners:
                self._owners.pop(f"/{name}").reconnect()  # its key is void
        connected = {robot: {link.address} for robot, link in self.connected().items()}
        is_complete = all(f"/{entry.name}" in connected for entry in self._fleet.robots)
        places = [] if is_complete else [entry.authorities for entry in self._fleet.robots]  # one may have another's
        wanted = self._found().union(*places, (link.address for link in self._links.values() if link.robot))
        for address in self._links.keys() - wanted:
            self._links.pop(address).close()
        for address in wanted - self._links.keys():
            self._links[address] = self._make_link(address, self._fleet, self._receive, self._accept)
        for link in self._twins():
            if not self.link(f"/{link.robot}"):
                link.reconnect()  # it is the only one now
        if self.engaged and now - self._stopped_at > CONFIRM_TIMEOUT:
            self._hurry(now)
        self._emergency = {robot: value for robot, value in self._emergency.items() if self.link(robot)}

    def close(self) -> None:
        """Disconnect all."""
        for link in self._links.values():
            link.close()

    def link(self, robot: Optional[str]) -> Optional[Link]:
        """Return the link to the robot, by its id, or None without a connection."""
        link = self._owners.get(robot)
        return link if link and f"/{link.robot}" == robot else None

    def connected(self) -> Dict[str, Link]:
        """Return the links to the robots that are connected, by their ids."""
        return {robot: link for robot, link in self._owners.items() if self.link(robot)}

    def send(self, robot: str, message: dict) -> bool:
        """Send a message to a robot; return whether there is a connection."""
        link = self.link(robot)
        return bool(link and link.send(message))

    @property
    def emergency(self) -> bool:
        """Whether all robots that are connected are stopped by the stop of all: also by another hub, or before this."""
        return self.engaged or bool(self._emergency) and all(self._emergency.values())

    def stop_all(self) -> None:
        """Stop all robots, each on its own connection, and those that come back."""
        self.engaged, self._stopped_at = True, time.monotonic()
        self._heard_since_stop.clear()
        self._emergency = dict.fromkeys(self._emergency, True)  # until a newer state says something else
        for link in self._links.values():
            if link.robot:
                stop(link)
        self._fleet.keep(STOP, True)

    def release_all(self) -> None:
        """End that."""
        for link in self._links.values():
            link.send({"type": "release"})
        self._end_stop()

    def _end_stop(self) -> None:
        self.engaged = False
        self._fleet.keep(STOP, False)

    def switch_cameras(self, on: bool) -> None:
        """Let pupils see what the cameras see, or not: at all robots, and at those that come back."""
        self._cameras = {"on": on}
        for link in self.connected().values():
            link.send({"type": "cameras", **self._cameras})
        self._fleet.keep(CAMERAS, self._cameras)

    def stop(self, robot: str) -> bool:
        """Stop one robot; return whether there is a connection."""
        return self.send(robot, {"type": "stop", "robot": robot})

    def release(self, robot: str) -> bool:
        """End that, and the stop of all at this robot alone, but for one from here; return whether it is connected."""
        if self._emergency.get(robot) and not self.engaged:
            self.send(robot, {"type": "release"})
        return self.send(robot, {"type": "release", "robot": robot})

    def unconfirmed(self) -> List[str]:
        """Return which robots have not said that the emergency stop of all robots, which is engaged, holds them."""
        held = {robot for robot in self._heard_since_stop
                if self.link(robot) and EMERGENCY_STOP in self._states.get(robot, {}).get("holds", ())}
        late = {f"/{link.robot}" for link in self._twins() if link.answered < self._stopped_at}
        return sorted(self._ids() - held | late) if self.emergency else []

    def rows(self) -> List[dict]:
        """Return the robots of the message "robots"."""
        entries = {f"/{entry.name}": entry for entry in self._fleet.robots}
        rows = []
        for robot in sorted(self._ids()):
            link = self.link(robot)
            address = link.address if link else entries[robot].authority if robot in entries else ""
            row = self._rows.get(robot) or absent_row(robot)
            rows.append({**row, "address": address and f"http://{address}/",
                         "version": link.version if link else row["version"]})
        return rows

    def states(self) -> Dict[str, dict]:
        """Return what each robot does; of one that is out of reach, why."""
        states = {}
        for robot in self._ids():
            link = self.link(robot)
            state = self._states.get(robot) if link else None
            delay = link.delay if link else None
            states[robot] = {**(state or absent_state(robot, self._problem(robot))),
                             "link": None if delay is None else round(1000 * delay, 1)}
            if link and self._emergency.get(robot) and not self.emergency:
                states[robot]["stopped"] = True
        return states

    def take_problems(self) -> List[Notice]:
        """Return what somebody has to solve, once each."""
        problems = {address: link.problem for address, link in self._links.items()
                    if link.problem and link.problem.code in REPORTED}
        new = [problem for address, problem in problems.items() if self._reported.get(address) != problem]
        self._reported = problems
        return new

    def _hurry(self, now):
        """Connect again where the stop may wait in a connection that is dead: a new one brings it first of all."""
        late = self.unconfirmed()
        for robot, link in self.connected().items():
            if robot in late and (link.is_backlogged() or not link.is_fresh(now)):
                link.reconnect()

    def _twins(self) -> List[Link]:
        """Return the links to robots that have another's name: they are only stopped and released with all."""
        return [link for link in self._links.values() if link.robot and self._owners.get(f"/{link.robot}") is not link]

    def _ids(self) -> Set[str]:
        return {f"/{entry.name}" for entry in self._fleet.robots} | self._owners.keys()

    def _problem(self, robot) -> Notice:
        """Return why a robot is out of reach: what happens at an address that the list has for it."""
        entry = next((each for each in self._fleet.robots if f"/{each.name}" == robot), None)
        problems = [self._links[address].problem for address in (entry.authorities if entry else ())
                    if address in self._links]
        return next(filter(None, problems), no_answer(robot))

    def _accept(self, link: Link) -> bool:
        """Take a link to a robot that has proven its name, also a second one of this name; not a second one to it."""
        robot = f"/{link.robot}"
        owner = self.link(robot)
        if owner and owner is not link and owner.is_fresh(time.monotonic()):
            if self.engaged:
                stop(link)
            link.problem = None if owner.instance == link.instance else say(
                "twice", robot=link.robot, address=owner.address, other=link.address)
            return bool(link.problem)
        self._owners[robot] = link
        if owner and owner is not link:
            owner.reconnect()
        self._emergency.pop(robot, None)
        self._states.pop(robot, None)
        self._heard_since_stop.discard(robot)
        if self.engaged:
            stop(link)
        if isinstance(self._cameras.get("on"), bool):
            link.send({"type": "cameras", "on": self._cameras["on"]})
        self._fleet.remember(link.robot, link.address)
        return True

    def _receive(self, link: Link, message: Any) -> None:
        robot = f"/{link.robot}"
        if self._owners.get(robot) is not link or not isinstance(message, dict):
            return
        if message["type"] == "robots":
            row = next((each for each in as_list(message.get("robots")) if each.get("id") == robot), None)
            known = completed(row, absent_row(robot), ROBOT_ROW) or self._rows.get(robot)
            self._rows[robot] = known and {**known, **named(robot)}
        elif message["type"] == "state":
            self._on_state(robot, message)
        else:
            self._pass_on(robot, message)

    def _on_state(self, robot, message):
        robots = message.get("robots")
        state = robots.get(robot) if isinstance(robots, dict) else None
        complete = completed(state, absent_state(robot, no_answer(robot)), ROBOT_STATE)
        if complete:
            self._states[robot] = complete
        else:
            self._states.pop(robot, None)  # its controller has ended
        if self._owners[robot].answered < self._stopped_at:
            return  # the state may be older than the stop
        self._heard_since_stop.add(robot)
        before = self._emergency.get(robot)
        self._emergency[robot] = message.get("emergency") is True
        is_complete = self._ids() <= self._emergency.keys()
        if self.engaged and before and is_complete and not any(self._emergency.values()):
            self._end_stop()  # another hub has released all


def stop(link: Link) -> None:
    """Stop all robots that this one's cockpit has; once the ping is answered, its state is newer than that."""
    link.send({"type": "stop"})
    link.ping()


def no_answer(robot: Optional[str]) -> Notice:
    """Return that this robot is out of reach."""
    return say("no_answer", robot=label(robot or ""))


def as_list(value: Any) -> List[dict]:
    """Return the objects in a list that somebody has sent."""
    return [each for each in value if isinstance(each, dict)] if isinstance(value, list) else []


def completed(fields: Any, otherwise: Dict[str, Any], part) -> Optional[Dict[str, Any]]:
    """Return the fields that another version of MorBot has sent, as they are here; None if they cannot be used."""
    if not isinstance(fields, dict):
        return None
    complete = {**otherwise, **{name: value for name, value in fields.items() if name in PARTS[part.type]}}
    return complete if part.accepts(complete) else None


def absent_row(robot: str) -> dict:
    """Return the row of a robot that was not heard of yet."""
    return {**RobotSnapshot(robot).description(), **named(robot)}


def named(robot: str) -> Dict[str, str]:
    """Return how a robot is shown: by the name that it has proven, whatever it says."""
    return {"label": label(robot), "color": web_color_of(robot.strip("/"))}


def absent_state(robot: str, problem: Notice) -> dict:
    """Return the state of a robot that is out of reach. problem: why."""
    state = RobotSnapshot(robot, answers=False).message(None, None, None, None, 0, None, 0)
    return {**state, "status": str(problem), "cause": problem.code, "template": problem.template,
            "arguments": {name: str(value) for name, value in problem.arguments.items()}}
