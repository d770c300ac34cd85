"""The socket of a robot's cockpit for the hub of its class: who has the class's key is a teacher here."""

import asyncio
import json
import logging
import time
from typing import Dict

from tornado.web import HTTPError

from jetbot.text import printable

from ..remote.identity import Identity
from ..remote.key import HUB, NONCE, RELAYED, ROBOT, WRONG_KEY, new_nonce, proof, proves
from ..remote.link import WORK, as_object
from ..remote.version import version_of
from ..session.protocol import ENDED, SILENT
from ..session.rights import TEACHER
from ..session.viewers import PageOwner
from .access import dialled
from .handlers import Socket
from .work import MAX_WORK, is_request

HANDSHAKE_TIMEOUT = 3.0  # s
MINUTE = 60.0            # s
MAX_ADDRESSES = 100      # that are refused in a minute and logged
VERSION = version_of()   # as this process started


class Refusals:
    """What the robot's log says of those who are refused: one line for an address and minute."""

    def __init__(self):
        self._logged_at: Dict[str, float] = {}

    def log(self, address: str, reason: str, now: float) -> None:
        """Log why a hub at this address was refused. now: in monotonic seconds."""
        self._logged_at = {each: at for each, at in self._logged_at.items() if now - at < MINUTE}
        if address not in self._logged_at and len(self._logged_at) < MAX_ADDRESSES:
            self._logged_at[address] = now
            logging.getLogger("rosout").warning("a hub at %s was refused: %s", address, reason)


REFUSALS = Refusals()


class HubSocket(Socket):
    """Sends a challenge; what answers it, and no browser, is a client. works: web.work.Works; instance: this start.

    links: the newest socket of each link of each hub. A hub names its links: what it has closed, the network may not
    have closed here, and it would keep the robot from its next driver.
    """

    acts = False
    max_message_size = 2 * MAX_WORK

    def initialize(self, access, pages, identity: Identity, works, instance: str, links: dict) -> None:
        super().initialize(access, pages)
        self._links, self._link = links, ("", "")
        self._identity, self._works, self._instance = identity, works, instance

    def prepare(self) -> None:
        if "Origin" in self.request.headers:  # a browser's: no web site gets as far as the challenge
            raise HTTPError(403)
        connection = self.request.connection.stream.socket
        self._reached = dialled(*connection.getsockname()[:2]) if connection else ""  # it was closed meanwhile

    def open(self) -> None:
        robot, class_name, _ = self._identity
        self._challenge = {"type": "challenge", "robot": robot, "class": class_name, "nonce": new_nonce(),
                           "instance": self._instance}
        self.send(json.dumps(self._challenge))
        asyncio.get_event_loop().call_later(HANDSHAKE_TIMEOUT, self._end_unproven)

    def on_message(self, message: object) -> None:
        if not self.viewer:
            self._check(as_object(message))
            return
        fields = as_object(message) if isinstance(message, str) and message.startswith(WORK) else None
        if fields and self.pages.record_activity(self.viewer, time.monotonic()):
            asyncio.ensure_future(self._work(fields))
        elif not fields:
            super().on_message(message)

    def _check(self, answer: dict) -> None:
        """Let in who proves to have the key and to have dialled this robot, and prove the same."""
        is_new = NONCE.fullmatch(str(answer.get("nonce")))
        if not is_new or not proves(answer.get("proof"), self._identity.key, HUB, self._challenge, answer):
            self._refuse(WRONG_KEY, "wrong key", "it has another key")
        elif answer.get("address") != self._reached:
            self._refuse(RELAYED, "wrong address", "it has connected to "
                         f"{printable(str(answer.get('address')))}, which passes on what it says to {self._reached}")
        else:
            self._let_in(answer)

    def _refuse(self, code, reason, sentence):
        REFUSALS.log(self.request.remote_ip, sentence, time.monotonic())
        self.close(code, reason)

    def _let_in(self, answer):
        own = proof(self._identity.key, ROBOT, self._challenge, answer)
        self.send(json.dumps({"type": "proof", "proof": own, "version": VERSION}))
        hub, link, alive = (answer.get(name) for name in ("hub", "link", "links"))
        if isinstance(hub, str) and isinstance(link, str) and isinstance(alive, list):
            self._replace(hub, link, alive)
        owner = PageOwner("hub", self.request.remote_ip)
        self.viewer = self.pages.join(self, TEACHER, None, owner, time.monotonic())
        if self.viewer:
            self.viewer.frames = answer.get("frames") is not False
        if self.ws_connection:
            self.ws_connection.stream.is_page = True
            self.ws_connection.stream.max_buffer_size = self.max_message_size  # a program is one message

    def _replace(self, hub, link, alive):
        """End the sockets from before: of this link, and of others that this hub has no more."""
        self._link = hub, link
        for other in [each for each in self._links if each[0] == hub and (each[1] == link or each[1] not in alive)]:
            socket = self._links.pop(other)
            if socket.viewer:
                self.pages.end(socket.viewer, ENDED, "the hub has connected again")
        self._links[self._link] = self

    def on_close(self) -> None:
        super().on_close()
        if self._links.get(self._link) is self:
            del self._links[self._link]

    def _end_unproven(self) -> None:
        if not self.viewer:
            self.close(SILENT, "no proof")

    async def _work(self, fields: dict) -> None:
        request, body = fields.get("request"), fields.get("body")
        status, answer = await self._works.answer(self.viewer.client, body) if is_request(body) else (400, {})
        self.send(json.dumps({"type": "work", "request": str(request)[:40], "status": status, "body": answer}))

