"""What a browser asks for: the page's files, a cookie for a code, and a client's socket."""

import contextlib
import json
import re
import secrets
import time
from pathlib import Path
from typing import Dict, Optional, Union

from tornado.httputil import HTTPServerRequest
from tornado.ioloop import IOLoop
from tornado.iostream import StreamClosedError
from tornado.web import HTTPError, RequestHandler
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from ..session.protocol import LOG_IN, NO_CODE
from ..session.viewers import PageOwner, Viewer
from .access import Access, TooManyTries
from .page_files import FOREVER, TYPES, File

POLICY = "default-src 'self'; frame-ancestors 'none'"
HEADERS = {"Content-Security-Policy": POLICY, "X-Frame-Options": "DENY",
           "X-Content-Type-Options": "nosniff", "Referrer-Policy": "no-referrer", "Cache-Control": "no-store"}
DOCUMENT_HEADERS = ["Content-Security-Policy", "X-Frame-Options", "Referrer-Policy", "Date"]
PAGES = {"": "index.html", "program": "program.html"}  # by what stands in the address
POLICIES = {  # of what needs another one
    "program.html": POLICY + "; style-src 'self' 'unsafe-inline'",  # Blockly and CodeMirror insert styles
    "python/worker.js": "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'",  # a pupil's program runs there
}
CLOSED = WebSocketClosedError, StreamClosedError
CLOSE_WAIT = 0.5  # s for the reason to arrive


def reached_address(request: HTTPServerRequest) -> str:
    """Return the address of this computer that a request came to."""
    connection = request.connection.stream.socket
    return connection.getsockname()[0] if connection else ""  # it was closed meanwhile


class Handler(RequestHandler):
    """Answers only what asks for this page, by its own name, and what acts only from this page."""

    acts = False

    def initialize(self, access: Access) -> None:
        self.access = access

    def set_default_headers(self) -> None:
        self.clear_header("Server")
        for name, value in HEADERS.items():
            self.set_header(name, value)

    def prepare(self) -> None:
        address = reached_address(self.request)
        if not self.access.accepts_host(self.request.headers.get("Host"), address):
            raise HTTPError(404)
        acts = self.acts or self.request.method not in ("GET", "HEAD")
        if acts and not self.access.accepts_origin(self.request.headers.get("Origin"), address):
            raise HTTPError(403)

    def check_type(self) -> None:
        """Refuse what is not sent as JSON, which no other site's form sends."""
        if self.request.headers.get("Content-Type", "").partition(";")[0].strip().lower() != "application/json":
            raise HTTPError(415)

    def give_cookie(self, name: str, value: str) -> None:
        """Set a cookie that no script can read and no other site can use, until the browser is closed."""
        self.set_cookie(name, value, expires_days=None, httponly=True, samesite="Strict")

    def write_error(self, status_code: int, **_) -> None:
        self.set_header("Content-Type", "text/plain; charset=UTF-8")
        self.finish(f"{status_code} {self._reason}\n")


class Page(Handler):
    """A file of the page. It needs no cookie: it shows nothing of the robots."""

    def initialize(self, access: Access, files: Dict[str, File]) -> None:
        super().initialize(access)
        self.files = files

    def get(self, name: str) -> None:
        name = PAGES.get(name, name)
        if name not in self.files:
            raise HTTPError(404)
        if name in PAGES.values() and not self.get_cookie(self.access.visitor_cookie):
            self.give_cookie(self.access.visitor_cookie, secrets.token_urlsafe(16))
        self._send(name, self.files[name])

    def _send(self, name, file):
        if file.cache == FOREVER:  # a part of a page: what protects pages only makes it longer
            for header in DOCUMENT_HEADERS:
                self.clear_header(header)
        for own in filter(name.endswith, POLICIES):
            self.set_header("Content-Security-Policy", POLICIES[own])
        self.set_header("Cache-Control", file.cache)
        self.set_header("Content-Type", f"{TYPES[Path(name).suffix]}; charset=UTF-8")
        self.set_header("Vary", "Accept-Encoding")
        accepted = re.findall(r"\w+", self.request.headers.get("Accept-Encoding", ""))
        for encoding, content in ("br", file.brotli), ("gzip", file.gzip):
            if content and encoding in accepted:
                self.set_header("Content-Encoding", encoding)
                break
        else:
            content = file.plain
        self.finish(content)

    def compute_etag(self) -> Optional[str]:
        """Return what a browser compares; of what it keeps for good, nothing."""
        return None if self._headers["Cache-Control"] == FOREVER else super().compute_etag()


class Login(Handler):
    """Takes {"code": ...}, and gives a cookie for it."""

    def post(self) -> None:
        try:
            visitor = self.get_cookie(self.access.visitor_cookie)
            grant = self.access.log_in(self._code(), self.request.remote_ip, visitor, time.monotonic())
        except TooManyTries:
            raise HTTPError(429) from None
        if not grant:
            raise HTTPError(403)
        self.give_cookie(self.access.cookie_name, grant.cookie)
        self.set_status(204)

    def _code(self) -> str:
        self.check_type()
        try:
            fields = json.loads(self.request.body)
        except (ValueError, RecursionError):
            fields = None
        if not isinstance(fields, dict) or set(fields) != {"code"} or not isinstance(fields["code"], str):
            raise HTTPError(400)
        return fields["code"]


class Socket(Handler, WebSocketHandler):
    """A page's connection to its session, for those who have access. pages: session.pages.Pages, or remote.hub.Hub."""

    acts = True
    viewer: Optional[Viewer] = None

    def initialize(self, access: Access, pages) -> None:
        super().initialize(access)
        self.pages = pages

    def check_origin(self, origin: str) -> bool:
        return True  # Handler.prepare has checked it, also where there is none

    def open(self) -> None:
        grant = self.access.grant(self.get_cookie(self.access.cookie_name), self.request.remote_ip,
                                  self.request.headers["Host"])
        if grant:
            owner = PageOwner(grant.label, self.request.remote_ip)
            self.viewer = self.pages.join(self, grant.role, grant.robot, owner, time.monotonic())
        else:
            self.close(LOG_IN, NO_CODE)
        if self.ws_connection:
            self.ws_connection.stream.is_page = True

    def close(self, code: Optional[int] = None, reason: Optional[str] = None) -> None:
        """Close the socket soon. Until then, of a client its stops are heard; what others send is not even read."""
        connection = self.ws_connection
        super().close(code, reason)
        if connection:
            connection.stream.is_page, connection.stream.is_ignored = False, self.viewer is None
            IOLoop.current().call_later(CLOSE_WAIT, connection.stream.close)

    def on_message(self, message: object) -> None:
        if self.viewer:
            self.pages.receive(self.viewer, message, time.monotonic())

    def on_ping(self, data: bytes) -> None:
        if self.viewer:
            self.pages.record_activity(self.viewer, time.monotonic())

    on_pong = on_ping

    def on_close(self) -> None:
        if self.viewer:
            self.pages.leave(self.viewer)

    def send(self, message: Union[str, bytes]) -> None:
        with contextlib.suppress(*CLOSED):
            # A write that fails needs no notice: the socket is closed, and ``on_close`` is called
            written = self.write_message(message, binary=isinstance(message, bytes))
            written.add_done_callback(lambda written: written.cancelled() or written.exception())

    def ping(self, data: bytes = b"") -> None:
        with contextlib.suppress(*CLOSED):
            super().ping(data)

    def is_backlogged(self) -> bool:
        """Return whether something that was sent is still in this process."""
        return self.ws_connection is None or self.ws_connection.stream.writing()
