"""The web server: a thread of its own, which nothing of ROS blocks."""

import asyncio
import contextlib
import logging
import socket
import threading
import time
from collections import Counter
from typing import List, Optional, Sequence

from tornado.httpserver import HTTPServer
from tornado.iostream import IOStream
from tornado.web import Application

from jetbot.wait import wait_until

from ..session.protocol import FRAME_INTERVAL, MAX_FRAME, PICTURE_INTERVAL
from .access import Access
from .handlers import Login, Page, Socket
from .page_files import read_files

MAX_CONNECTIONS = 512      # a process may have 1,024 files, and the ROS side needs some
MAX_BODY = 1000            # bytes of a request's body
MAX_HEADERS = 16384        # bytes; all programs on a computer's ports share their cookies
IDLE_TIMEOUT = 10.0        # s for the headers of a request, and for its body
CHUNK = 1024               # bytes that are read at once: a few small messages, so that a stop soon has its turn
MAX_UNREAD = 131072        # bytes that are dropped when a connection ends
SEND_BUFFER = 65536        # bytes in the kernel: more would be old when it arrives
CLOSE_TIMEOUT = 0.1        # s for the clients to answer a close
START_TIMEOUT = 5.0        # s
SHUTDOWN_TIMEOUT = 1.0     # s


class FairStream(IOStream):
    """Reads one chunk each time it is its turn.

    Tornado handles frames for as long as there are more: one client without pause would be the only one that is served.
    address: where it comes from; is_page: whether it is the socket of a client; is_ignored: whether what arrives is
    dropped.
    """

    address, is_page, is_ignored, _turn = "", False, False, False

    def read_from_fd(self, buf) -> Optional[int]:
        self._turn = self.is_ignored or not self._turn
        count = super().read_from_fd(buf) if self._turn else None  # None: nothing more has arrived
        return None if count and self.is_ignored else count

    def close_fd(self) -> None:
        with contextlib.suppress(OSError):
            self.socket.recv(MAX_UNREAD)  # else the connection is reset, and the reason for its end lost
        super().close_fd()


class LimitedServer(HTTPServer):
    """Serves MAX_CONNECTIONS at a time, each in its turn."""

    def initialize(self, *arguments, **options) -> None:
        super().initialize(*arguments, **options)
        self._streams: List[FairStream] = []  # the oldest first

    def handle_stream(self, stream: IOStream, address: tuple) -> None:
        self._streams = [each for each in self._streams if not each.closed()]
        if len(self._streams) >= MAX_CONNECTIONS:
            self._make_room()
        stream.socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SEND_BUFFER)
        stream = FairStream(stream.socket, max_buffer_size=2 * MAX_HEADERS, read_chunk_size=CHUNK)
        stream.set_nodelay(True)
        stream.address = address[0]
        self._streams.append(stream)
        super().handle_stream(stream, address)

    def _make_room(self) -> None:
        """Close the oldest connection that is no client's, at the address that has the most of them."""
        others = [stream for stream in self._streams if not stream.is_page]
        counts = Counter(stream.address for stream in others)
        max(others, key=lambda stream: counts[stream.address]).close()

    def close_streams(self) -> None:
        """Close all connections."""
        for stream in self._streams:
            stream.close()


class Server:
    """Serves the page and its socket on sockets that listen already.

    pages: session.pages.Pages, or remote.hub.Hub; others: what else is served, as Tornado's routes.
    """

    def __init__(self, sockets: List[socket.socket], access: Access, pages, others: Sequence[tuple]):
        self._sockets, self._pages = sockets, pages
        self._application = Application(
            [(r"/login", Login, {"access": access}), (r"/socket", Socket, {"access": access, "pages": pages}),
             *others, (r"/(.*)", Page, {"access": access, "files": read_files()})],
            websocket_max_message_size=MAX_FRAME, log_function=lambda handler: None)
        self._thread = threading.Thread(target=lambda: asyncio.run(self._serve()), daemon=True)
        self._started, self._ended = threading.Event(), threading.Event()

    def start(self) -> None:
        """Serve from now on."""
        logging.getLogger("tornado.general").setLevel(logging.ERROR)  # not what clients do wrong
        self._thread.start()
        wait_until(lambda: self._started.is_set() or not self.is_alive(), START_TIMEOUT)

    def is_alive(self) -> bool:
        """Return whether the page is served."""
        return self._thread.is_alive()

    def end(self) -> None:
        """Disconnect all clients and serve no more."""
        if self.is_alive():
            self._ended.set()
            self._thread.join(SHUTDOWN_TIMEOUT)

    async def _serve(self) -> None:
        server = LimitedServer(self._application, max_body_size=MAX_BODY, max_header_size=MAX_HEADERS,
                               idle_connection_timeout=IDLE_TIMEOUT, body_timeout=IDLE_TIMEOUT)
        server.add_sockets(self._sockets)
        self._started.set()
        pictures = asyncio.ensure_future(self._send_pictures())
        while not self._ended.is_set():
            self._pages.tick(time.monotonic())
            await asyncio.sleep(FRAME_INTERVAL)  # Tornado's PeriodicCallback halts when the clock is set back
        pictures.cancel()
        server.stop()
        self._pages.close()
        await asyncio.sleep(CLOSE_TIMEOUT)
        server.close_streams()
        await asyncio.sleep(0)

    async def _send_pictures(self) -> None:
        while True:
            somebody_looks = self._pages.send_pictures(time.monotonic())
            await asyncio.sleep(PICTURE_INTERVAL if somebody_looks else FRAME_INTERVAL)
