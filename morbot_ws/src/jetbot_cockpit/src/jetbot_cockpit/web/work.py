"""What the page keeps on this computer: the programs of the robots that its person may drive."""

import asyncio
import json
from typing import Any, Callable, Dict, Optional, Tuple

from tornado.web import HTTPError, stream_request_body

from ..classroom.classroom import Classroom, DiskBusy
from ..classroom.programs import Refused
from ..notices import say
from ..session.messages import REQUESTS, TEXT, fit
from ..session.rights import TEACHER, Client
from ..session.snapshot import label
from .access import Access
from .handlers import Handler

MAX_WORK = 160 * 1024  # bytes of a request: a program, in which each quote is escaped


class Works:
    """Answers what is asked of a class's programs. knows: whether there is a robot of this name."""

    def __init__(self, classroom: Classroom, knows: Callable[[str], bool]):
        self._classroom, self._knows = classroom, knows

    async def answer(self, client: Client, fields: Dict[str, Any]) -> Tuple[int, dict]:
        """Return an HTTP status, and what is answered: a Notice where something is refused."""
        try:
            return 200, await self._answer(client, **fields)
        except Refused as refusal:
            return 409, refusal.notice.fields()
        except DiskBusy:
            return 503, say("disk_busy").fields()
        except OSError as error:
            return 507, say("disk", problem=error.strerror or error).fields()

    async def _answer(self, client, do: str, robot: str = None, **fields: Any) -> dict:
        self._check(client, robot)
        if fields.pop("class", None) not in (None, self._classroom.id):
            raise Refused(say("other_class"))
        return {"class": self._classroom.id, **await self._result(do, robot, fields)}

    async def _result(self, do, robot, fields):
        programs = self._classroom.programs
        if do == "list":
            return {"programs": programs.rows(robot)}
        if do == "open":
            return programs.open(robot, fields["id"]).opened(fields.get("version"))
        if do == "save":
            done = self._classroom.do(lambda: programs.save(robot, **fields))
        else:
            done = self._classroom.do(lambda: programs.delete(robot, **fields, deleted=do == "delete"))
        return (await asyncio.wrap_future(done)).row()

    def _check(self, client, robot):
        if not (client.role == TEACHER if robot is None else client.may_drive(robot)):
            raise Refused(say("own_programs_only"))
        if robot is not None and not self._knows(robot) and not self._classroom.programs.changed(robot):
            raise Refused(say("ended", robot=label(robot)))


@stream_request_body
class Work(Handler):
    """Takes {"do": ...} with the fields of REQUESTS; answers with JSON.

    works: what answers it (Works, or remote.hub.Hub).
    """

    def initialize(self, access: Access, works) -> None:
        super().initialize(access)
        self._works, self._body = works, bytearray()

    def prepare(self) -> None:
        super().prepare()
        grant = self.access.grant(self.get_cookie(self.access.cookie_name), self.request.remote_ip,
                                  self.request.headers["Host"])
        if not grant:
            raise HTTPError(403)
        self.check_type()
        self._client = Client(0, grant.role, grant.robot)
        self.request.connection.set_max_body_size(MAX_WORK)  # only now: who has no code sends no more than others

    def data_received(self, chunk: bytes) -> None:
        self._body += chunk

    async def post(self) -> None:
        fields = parse(bytes(self._body))
        if fields is None:
            raise HTTPError(400)
        status, answer = await self._works.answer(self._client, fields)
        self.set_status(status)
        self.finish(answer)


def parse(body: bytes) -> Optional[Dict[str, Any]]:
    """Return the fields of a request, or None if it is not of the documented form."""
    try:
        fields = json.loads(body, parse_int=lambda digits: int(digits[:11]))  # all of a long one would take long
    except (ValueError, RecursionError):
        return None
    return fields if is_request(fields) else None


def is_request(fields: Any) -> bool:
    """Return whether these are the fields of a request."""
    do = fields.get("do") if isinstance(fields, dict) else None
    row = REQUESTS.get(do) if isinstance(do, str) else None
    return row is not None and fit(fields, {"do": TEXT, **row.fields})
