"""What robots answer, each by a link of its own, as a hub's."""

import asyncio
import time
from typing import Any, Callable, Dict, List, NamedTuple, Optional

from jetbot_cockpit.remote.fleet import Entry, Fleet
from jetbot_cockpit.remote.link import Link
from jetbot_cockpit.remote.robots import absent_state, completed, no_answer
from jetbot_cockpit.session.messages import ROBOT_STATE

TIMEOUT = 3.0    # s for each robot
INTERVAL = 0.05  # s


class Answer(NamedTuple):
    """What a robot has said. version: a commit or ""; delay: s there and back; state: see the message "state".

    address: HOST:PORT where it answers, or "".
    """

    entry: Entry
    version: str = ""
    delay: Optional[float] = None
    state: Optional[Dict[str, Any]] = None
    emergency: bool = False
    problem: str = "no answer"
    address: str = ""

    def is_well(self) -> bool:
        """Return whether the robot has said what it does, and its controller answers."""
        return not self.problem and bool(self.state and self.state["answers"])

    def is_complete(self) -> bool:
        """Return whether there is nothing to wait for."""
        return self.is_well() and self.delay is not None

    def driver(self) -> str:
        """Return who drives it, or ""."""
        if not self.state:
            return ""
        driver = self.state["driver"]
        if driver:
            return str(driver.get("name") or "somebody")
        return self.state["program"] or "a program" if self.state["state"] == "driving" else ""

    def text(self) -> str:
        """Return what it does, or why it is missing."""
        if self.problem or not self.state:
            return self.problem or "its cockpit sees no robot"
        if not self.state["answers"]:
            return "its controller does not answer"
        return "emergency stop" if self.emergency else str(self.state["status"])


def ask(fleet: Fleet, entries: List[Entry], timeout: float = TIMEOUT,
        until: Callable[[Answer], bool] = Answer.is_complete) -> List[Answer]:
    """Ask all at once, each until its answer is so, or for ``timeout`` s; return the last answers."""
    async def all_of_them() -> List[Answer]:
        return list(await asyncio.gather(*(_ask(fleet, entry, timeout, until) for entry in entries)))
    return asyncio.run(all_of_them())


async def _ask(fleet: Fleet, entry: Entry, timeout: float, until: Callable[[Answer], bool]) -> Answer:
    said: Dict[Link, dict] = {}

    def receive(link: Link, message: Any) -> None:
        if isinstance(message, dict) and message.get("type") == "state":
            said[link] = message
    links, ends_at = [Link(address, fleet, receive) for address in entry.authorities], time.monotonic() + timeout
    try:
        while True:
            answers = [_answer(entry, link, said.get(link, {})) for link in links]
            answer = next((each for each in answers if not each.problem), answers[0])
            if until(answer) or time.monotonic() > ends_at:
                return answer
            await asyncio.sleep(INTERVAL)
    finally:
        for link in links:
            link.close()


def _answer(entry: Entry, link: Link, message: dict) -> Answer:
    """Return what a robot has said by a link. message: its last "state"."""
    if not link.robot:
        return Answer(entry, problem=str(link.problem or "") or f"No connection to {link.address}.")
    if link.robot != entry.name:
        return Answer(entry, problem=f"Another robot answers there: {link.robot}.")
    robots, robot = message.get("robots"), f"/{entry.name}"
    state = message and completed(robots.get(robot) if isinstance(robots, dict) else None,
                      absent_state(robot, no_answer(robot)), ROBOT_STATE)
    return Answer(entry, link.version, link.delay, state or None, message.get("emergency") is True, "", link.address)
