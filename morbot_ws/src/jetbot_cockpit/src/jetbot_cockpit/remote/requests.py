"""What pages ask of the programs that the robots keep: each request goes to its robot, one about all to all of them."""

import asyncio
import itertools
from typing import Any, Dict, Tuple

from ..notices import Notice, say
from .claims import is_answer
from .robots import RemoteRobots, no_answer

TIMEOUT = 5.0  # s
Answer = Tuple[int, Dict[str, Any]]


class Requests:
    """Answers as web.work.Works. id: the class's: a page keeps what it has of another class to itself."""

    def __init__(self, robots: RemoteRobots, id: str):
        self._robots, self._id = robots, id
        self._waiting: Dict[Tuple[str, str], asyncio.Future] = {}  # by robot and request
        self._numbers = itertools.count(1)

    async def answer(self, fields: Dict[str, Any]) -> Answer:
        """Return an HTTP status, and what is answered: a Notice where something is refused."""
        if fields.get("class") not in (None, self._id):
            return refused(say("other_class"))
        asked = {name: value for name, value in fields.items() if name != "class"}  # each robot has an id of its own
        if fields.get("robot") is None:
            return await self._of_all(asked)
        status, body = await self._ask(fields["robot"], asked)
        return status, {**body, "class": self._id} if status == 200 else body

    async def _of_all(self, asked) -> Answer:
        """Return the programs of all robots that answer."""
        robots = sorted(self._robots.connected())
        answers = await asyncio.gather(*(self._ask(robot, {**asked, "robot": robot}) for robot in robots))
        programs = [row for status, body in answers if status == 200 for row in body.get("programs", ())]
        return 200, {"class": self._id, "programs": programs}

    async def _ask(self, robot: str, body: Dict[str, Any]) -> Answer:
        request, done = str(next(self._numbers)), asyncio.get_event_loop().create_future()
        self._waiting[robot, request] = done
        try:
            if not self._robots.send(robot, {"type": "work", "request": request, "body": body}):
                return refused(no_answer(robot))
            return await asyncio.wait_for(done, TIMEOUT)
        except asyncio.TimeoutError:
            return refused(no_answer(robot))
        finally:
            del self._waiting[robot, request]

    def take(self, robot: str, message: Dict[str, Any]) -> None:
        """Take what a robot answers."""
        done = self._waiting.get((robot, str(message.get("request"))))
        status, body = message.get("status"), message.get("body")
        if done and not done.done():
            done.set_result((status, body) if is_answer(robot.strip("/"), status, body) else refused(no_answer(robot)))


def refused(notice: Notice) -> Answer:
    """Return the answer for a request that cannot be done."""
    return 409, notice.fields()
