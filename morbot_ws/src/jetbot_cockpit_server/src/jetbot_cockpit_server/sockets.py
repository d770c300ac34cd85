"""The WebSocket of a client."""

import contextlib
import time
from typing import Callable, Optional

from tornado.ioloop import IOLoop
from tornado.iostream import IOStream, StreamClosedError
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from .access import Access
from .hub import LOG_IN, Hub, Viewer
from .pages import Handler

CLOSE_TIMEOUT = 1.0  # s for the page to answer a close
CLOSED = WebSocketClosedError, StreamClosedError


class Socket(Handler, WebSocketHandler):
    """A connection to the hub, for those who have access. keep: is called with the stream of each of these."""

    acts = True
    viewer: Optional[Viewer] = None

    def initialize(self, access: Access, hub: Hub, keep: Callable[[IOStream], None]) -> None:
        super().initialize(access)
        self.hub, self.keep = hub, keep

    def check_origin(self, origin: str) -> bool:
        return True  # Handler.prepare has checked it, also where there is none

    def open(self) -> None:
        grant = self.access.grant(self.get_cookie(self.access.cookie_name), self.request.remote_ip,
                                  self.request.headers["Host"])
        if grant:
            self.viewer = self.hub.join(self, grant, time.monotonic())
        else:
            self.close(LOG_IN, "log in")
        if self.viewer:
            self.keep(self.ws_connection.stream)

    def on_message(self, message: object) -> None:
        if self.viewer:
            self.hub.receive(self.viewer, message, time.monotonic())

    def on_ping(self, data: bytes) -> None:
        if self.viewer:
            self.hub.record_activity(self.viewer, time.monotonic())

    on_pong = on_ping

    def on_close(self) -> None:
        if self.viewer:
            self.hub.leave(self.viewer)

    def send(self, text: str) -> None:
        with contextlib.suppress(*CLOSED):
            self.write_message(text).add_done_callback(retrieve)

    def ping(self, data: bytes = b"") -> None:
        with contextlib.suppress(*CLOSED):
            super().ping(data)

    def close(self, code: Optional[int] = None, reason: Optional[str] = None) -> None:
        stream = self.ws_connection and self.ws_connection.stream
        super().close(code, reason)
        if stream:
            IOLoop.current().call_later(CLOSE_TIMEOUT, stream.close)

    def is_backlogged(self) -> bool:
        return self.ws_connection is None or self.ws_connection.stream.writing()


def retrieve(future) -> None:
    """Take notice of a write that has failed: the socket is closed, and ``on_close`` says so."""
    if not future.cancelled():
        future.exception()
