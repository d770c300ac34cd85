"""The web server: a thread of its own, which nothing of ROS blocks."""

import asyncio
import itertools
import logging
import socket
import threading
import time
from typing import List, Optional

from tornado.httpserver import HTTPServer
from tornado.ioloop import PeriodicCallback
from tornado.iostream import IOStream
from tornado.web import Application

from jetbot.wait import wait_until

from .access import Access
from .connections import Connections
from .hub import FRAME_INTERVAL, Hub
from .limits import TokenBucket
from .pages import Login, Missing, Page, read_files
from .sockets import Socket

MAX_BODY = 1000            # bytes of a request's body
MAX_HEADERS = 16384        # bytes; all programs on a computer's ports share their cookies
MAX_FRAME = 8192           # bytes of a message that is read at all, to be refused with a reason
IDLE_TIMEOUT = 10.0        # s for the headers of a request, and for its body
CHUNK = 4096               # bytes that are read at once
MAX_BYTE_RATE = 65536      # bytes per second of a connection
SEND_BUFFER = 65536        # bytes in the kernel: more would be old when it arrives
EXPIRE_INTERVAL = 1.0      # s
CLOSE_TIMEOUT = 0.1        # s for the clients to answer a close
START_TIMEOUT = 5.0        # s
SHUTDOWN_TIMEOUT = 1.0     # s


class LimitedServer(HTTPServer):
    """Limits the connections, and how fast each may send."""

    def initialize(self, *arguments, connections: Connections, **options) -> None:
        super().initialize(*arguments, **options)
        self._admitted = connections

    def handle_stream(self, stream: IOStream, address: tuple) -> None:
        self._admitted.admit(stream, address[0], time.monotonic())
        stream.set_nodelay(True)
        stream.socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SEND_BUFFER)
        limit_reading(stream)
        super().handle_stream(stream, address)


def limit_reading(stream: IOStream) -> None:
    """Read one chunk of a stream each time it is its turn; end it if it sends more than MAX_BYTE_RATE.

    Tornado handles frames for as long as there are more: one client without pause would be the only one that is served.
    """
    read, bucket = stream.read_from_fd, TokenBucket(MAX_BYTE_RATE, MAX_BYTE_RATE, time.monotonic())
    turn = itertools.cycle((True, False))

    def read_in_turn(buffer):
        if not next(turn):
            return None  # as if nothing more had arrived
        count = read(buffer)
        return count if not count or bucket.take(time.monotonic(), count) else 0  # 0: as if it had ended

    stream.read_from_fd = read_in_turn


class Server:
    """Serves the page and its socket on sockets that listen already."""

    def __init__(self, sockets: List[socket.socket], access: Access, hub: Hub):
        self._sockets, self._hub, self._connections = sockets, hub, Connections()
        common = {"access": access}
        self._application = Application(
            [(r"/login", Login, common),
             (r"/socket", Socket, {**common, "hub": hub, "keep": self._connections.keep}),
             (r"/([\w.]*)", Page, {**common, "files": read_files()})],
            default_handler_class=Missing, default_handler_args=common, websocket_max_message_size=MAX_FRAME,
            log_function=lambda handler: None)
        self._loop: Optional[asyncio.AbstractEventLoop] = None
        self._thread = threading.Thread(target=lambda: asyncio.run(self._serve()), daemon=True)
        self._started = threading.Event()

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
            self._loop.call_soon_threadsafe(self._ended.set)
            self._thread.join(SHUTDOWN_TIMEOUT)

    async def _serve(self) -> None:
        self._loop, self._ended = asyncio.get_running_loop(), asyncio.Event()
        server = LimitedServer(
            self._application, connections=self._connections, max_body_size=MAX_BODY, max_header_size=MAX_HEADERS,
            max_buffer_size=2 * MAX_HEADERS, chunk_size=CHUNK, idle_connection_timeout=IDLE_TIMEOUT,
            body_timeout=IDLE_TIMEOUT)
        server.add_sockets(self._sockets)
        tasks = [PeriodicCallback(lambda: self._hub.tick(time.monotonic()), 1000 * FRAME_INTERVAL),
                 PeriodicCallback(lambda: self._connections.expire(time.monotonic()), 1000 * EXPIRE_INTERVAL)]
        for task in tasks:
            task.start()
        self._started.set()
        await self._ended.wait()
        for task in tasks:
            task.stop()
        server.stop()
        self._hub.close()
        await asyncio.sleep(CLOSE_TIMEOUT)
        self._connections.close()
        await asyncio.sleep(0)
