"""What the page keeps on this computer: the programs of the robots that its person may drive."""

import asyncio
import json
from typing import Any, Callable, Dict

from tornado.web import HTTPError, stream_request_body

from ..classroom.classroom import Classroom, DiskBusy
from ..classroom.programs import Refused, is_id, is_program_name, is_version
from ..session.protocol import fit, is_robot, is_robot_or_all
from ..session.rights import TEACHER, Client
from .access import Access
from .handlers import Handler

MAX_WORK = 160 * 1024  # bytes of a request: a program, in which each quote is escaped
BUSY = "This computer's disk is busy. The page tries again."
OTHERS = "With your code, you see only the programs of your own robot."
ENDED = "This robot has ended."


def is_text(value: Any) -> bool:
    """Return whether this is text."""
    return isinstance(value, str)


# The fields of each request, by its "do"
WORK: Dict[str, Dict[str, Callable[[Any], bool]]] = {
    "list": {"robot": is_robot_or_all},  # None: of all robots
    "open": {"robot": is_robot, "id": is_id},
    "save": {"robot": is_robot, "id": is_id, "version": is_version, "name": is_program_name, "program": is_text},
    "delete": {"robot": is_robot, "id": is_id, "version": is_version},
    "restore": {"robot": is_robot, "id": is_id, "version": is_version},
}


@stream_request_body
class Work(Handler):
    """Takes {"do": ...} with the fields of WORK; answers with JSON, which says in "text" why something is refused."""

    def initialize(self, access: Access, classroom: Classroom, knows: Callable[[str], bool]) -> None:
        super().initialize(access)
        self._classroom, self._knows, self._body = classroom, knows, bytearray()

    def prepare(self) -> None:
        super().prepare()
        grant = self.access.grant(self.get_cookie(self.access.cookie_name), self.request.remote_ip,
                                  self.request.headers["Host"])
        if not grant:
            raise HTTPError(403)
        self.check_type()
        self._client = Client(0, grant.label, grant.role, grant.robot)
        self.request.connection.set_max_body_size(MAX_WORK)  # only now: who has no code sends no more than others

    def data_received(self, chunk: bytes) -> None:
        self._body += chunk

    async def post(self) -> None:
        fields = parse(bytes(self._body))
        try:
            self.finish(await self._answer(**fields))
        except Refused as refusal:
            self._refuse(409, str(refusal))
        except DiskBusy:
            self._refuse(503, BUSY)
        except OSError as error:
            self._refuse(507, f"This computer could not keep it: {error.strerror or error}.")

    async def _answer(self, do: str, robot: str = None, **fields: Any) -> dict:
        self._check(robot)
        programs = self._classroom.programs
        if do == "list":
            return {"programs": programs.rows(robot)}
        if do == "open":
            return programs.open(robot, **fields)._asdict()
        if do == "save":
            done = self._classroom.do(lambda: programs.save(robot, **fields))
        else:
            done = self._classroom.do(lambda: programs.delete(robot, **fields, deleted=do == "delete"))
        return (await asyncio.wrap_future(done)).row()

    def _check(self, robot):
        if not (self._client.role == TEACHER if robot is None else self._client.may_drive(robot)):
            raise Refused(OTHERS)
        if robot is not None and not self._knows(robot) and not self._classroom.programs.changed(robot):
            raise Refused(ENDED)

    def _refuse(self, status, text):
        self.set_status(status)
        self.finish({"text": text})


def parse(body: bytes) -> Dict[str, Any]:
    """Return the fields of a request. Raise HTTPError for one that is not of the documented form."""
    try:
        fields = json.loads(body, parse_int=lambda digits: int(digits[:11]))  # all of a long one would take long
    except (ValueError, RecursionError):
        fields = None
    do = fields.get("do") if isinstance(fields, dict) else None
    checks = WORK.get(do) if isinstance(do, str) else None
    if checks is None or not fit(fields, {"do": is_text, **checks}):
        raise HTTPError(400)
    return fields
