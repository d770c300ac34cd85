"""What robots answer, each by a link of its own, as a hub's."""

import asyncio
import time
from typing import Any, Callable, Dict, List, NamedTuple, Optional

from jetbot_cockpit.remote.fleet import Entry, Fleet
from jetbot_cockpit.remote.link import Link

TIMEOUT = 3.0    # s for each robot
INTERVAL = 0.05  # s


class Answer(NamedTuple):
    """What a robot has said. version: a commit or ""; delay: s there and back; state: see the message "state"."""

    entry: Entry
    version: str = ""
    delay: Optional[float] = None
    state: Optional[Dict[str, Any]] = None
    emergency: bool = False
    problem: str = "no answer"

    def is_complete(self) -> bool:
        """Return whether the robot has said all, and its controller answers."""
        return not self.problem and self.delay is not None and bool(self.state and self.state["answers"])

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
    said: Dict[str, dict] = {}

    def receive(_: Link, message: Any) -> None:
        if isinstance(message, dict):
            said[str(message.get("type"))] = message
    link, ends_at = Link(entry.authority, fleet, receive), time.monotonic() + timeout
    try:
        while True:
            answer = _answer(entry, link, said)
            if until(answer) or time.monotonic() > ends_at:
                return answer
            await asyncio.sleep(INTERVAL)
    finally:
        link.close()


def _answer(entry: Entry, link: Link, said: Dict[str, dict]) -> Answer:
    if not link.robot:
        said.clear()
        return Answer(entry, problem=str(link.problem or "") or f"No connection to {entry.authority}.")
    if link.robot != entry.name:
        return Answer(entry, problem=f"Another robot answers there: {link.robot}.")
    message = said.get("state", {})
    return Answer(entry, link.version, link.delay, message.get("robots", {}).get(f"/{entry.name}"),
                  message.get("emergency") is True, "")
