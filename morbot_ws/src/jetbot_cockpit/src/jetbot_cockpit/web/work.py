"""What the page keeps on this computer: the programs of the robots that its person may drive."""

import asyncio
import json
from typing import Any, Callable, Dict

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


@stream_request_body
class Work(Handler):
    """Takes {"do": ...} with the fields of REQUESTS; answers with JSON: a Notice where something is refused."""

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
        self._client = Client(0, grant.role, grant.robot)
        self.request.connection.set_max_body_size(MAX_WORK)  # only now: who has no code sends no more than others

    def data_received(self, chunk: bytes) -> None:
        self._body += chunk

    async def post(self) -> None:
        fields = parse(bytes(self._body))
        try:
            self.finish(await self._answer(**fields))
        except Refused as refusal:
            self._refuse(409, refusal.notice)
        except DiskBusy:
            self._refuse(503, say("disk_busy"))
        except OSError as error:
            self._refuse(507, say("disk", problem=error.strerror or error))

    async def _answer(self, do: str, robot: str = None, **fields: Any) -> dict:
        self._check(robot)
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

    def _check(self, robot):
        if not (self._client.role == TEACHER if robot is None else self._client.may_drive(robot)):
            raise Refused(say("own_programs_only"))
        if robot is not None and not self._knows(robot) and not self._classroom.programs.changed(robot):
            raise Refused(say("ended", robot=label(robot)))

    def _refuse(self, status, notice):
        self.set_status(status)
        self.finish(notice.fields())


def parse(body: bytes) -> Dict[str, Any]:
    """Return the fields of a request. Raise HTTPError for one that is not of the documented form."""
    try:
        fields = json.loads(body, parse_int=lambda digits: int(digits[:11]))  # all of a long one would take long
    except (ValueError, RecursionError):
        fields = None
    do = fields.get("do") if isinstance(fields, dict) else None
    row = REQUESTS.get(do) if isinstance(do, str) else None
    if row is None or not fit(fields, {"do": TEXT, **row.fields}):
        raise HTTPError(400)
    return fields
