"""A hub's socket to one robot's cockpit, which connects again by itself. Times are monotonic seconds."""

import asyncio
import contextlib
import json
import math
import time
from typing import Any, Callable, Optional, Union

from tornado.httpclient import HTTPClientError, HTTPRequest
from tornado.iostream import StreamClosedError
from tornado.simple_httpclient import HTTPTimeoutError
from tornado.websocket import WebSocketClosedError, WebSocketError, websocket_connect

from ..notices import Notice, say
from .fleet import Fleet
from .key import HUB, ROBOT, ROBOT_NAME, Nonces, new_nonce, proof, proves

OPEN_TIMEOUT = 2.0     # s for a connection, and for its handshake
SILENCE_TIMEOUT = 3.0  # s without a message: the link is cut off
RETRY_INTERVAL = 0.5   # s
PING_INTERVAL = 0.5    # s
FRESH = 1.5            # s without a message after which nothing that moves is sent: it would arrive late
MAX_MESSAGE = 512 * 1024  # bytes
MAX_RATE = 400         # messages a second: a robot that sends more is disconnected
LOST = (OSError, HTTPClientError, HTTPTimeoutError, StreamClosedError, WebSocketClosedError, WebSocketError,
        asyncio.TimeoutError)


class Link:
    """address: HOST:PORT; receive: is called with the link and each message, a dict or bytes, once ``robot`` is proven.

    robot: the name that the cockpit has proven, "" without a connection; client: this link's id there;
    instance: which start of the cockpit this is; version: the commit that it runs, or ""; problem: why there is no
    connection, or None; delay: s for a message there and back, or None.
    """

    def __init__(self, address: str, fleet: Fleet, receive: Callable[["Link", Union[dict, bytes]], None]):
        self.address, self._fleet, self._receive = address, fleet, receive
        self.robot, self.instance, self.version, self.client = "", "", "", 0
        self.problem: Optional[Notice] = None
        self.delay: Optional[float] = None
        self.heard_at = -math.inf
        self._connection: Any = None
        self._claimed = ""  # a name that is not proven yet
        self._count = 0  # of messages since the last ping
        self._nonces = Nonces("", "")
        self._task = asyncio.ensure_future(self._run())

    def close(self) -> None:
        """End the connection for good."""
        self._task.cancel()
        self._drop()

    def is_fresh(self, now: float) -> bool:
        """Return whether the robot was heard of a moment ago."""
        return bool(self.robot) and now - self.heard_at < FRESH

    def send(self, message: Union[dict, str]) -> bool:
        """Send a message; return whether there is a connection. Never blocks."""
        connection = self._connection
        if connection is None:
            return False
        with contextlib.suppress(WebSocketClosedError, StreamClosedError):
            written = connection.write_message(message if isinstance(message, str) else json.dumps(message))
            written.add_done_callback(lambda written: written.cancelled() or written.exception())
            return True
        return False

    def is_backlogged(self) -> bool:
        """Return whether something that was sent is still in this process."""
        return self._connection is None or self._connection.stream.writing()

    async def _run(self) -> None:
        while True:
            try:
                await self._stay_connected()
            except LOST:
                self.problem = self.problem or say("no_link", address=self.address)
            self._drop()
            await asyncio.sleep(RETRY_INTERVAL)

    async def _stay_connected(self) -> None:
        request = HTTPRequest(f"ws://{self.address}/hub", connect_timeout=OPEN_TIMEOUT, request_timeout=OPEN_TIMEOUT)
        self._ended = asyncio.Event()
        early: list = []  # what arrives before this task goes on

        def on_message(data):
            (self._on_message if self._connection else early.append)(data)
        self._connection = await asyncio.wait_for(websocket_connect(
            request, on_message_callback=on_message, max_message_size=MAX_MESSAGE), OPEN_TIMEOUT)
        self._connection.stream.set_nodelay(True)
        for data in early:
            self._on_message(data)
        opened_at = self.heard_at = time.monotonic()
        while not self._ended.is_set():
            now = time.monotonic()
            if now - (self.heard_at if self.robot else opened_at) > SILENCE_TIMEOUT:
                return
            self._count = 0
            if self.robot:
                self.send({"type": "ping", "sent": now})
            with contextlib.suppress(asyncio.TimeoutError):
                await asyncio.wait_for(self._ended.wait(), PING_INTERVAL)

    def _drop(self) -> None:
        connection, self._connection = self._connection, None
        self.robot, self._claimed, self.delay = "", "", None
        if connection:
            connection.close()
            connection.stream.close()  # a close that is not answered lasts for minutes

    def _on_message(self, data: Union[str, bytes, None]) -> None:
        self._count += 1
        if data is None or self._count > MAX_RATE * PING_INTERVAL:
            self._ended.set()
            return
        self.heard_at = time.monotonic()
        message = data if isinstance(data, bytes) else as_object(data)
        if not self.robot:
            self._shake_hands(message)
        elif isinstance(message, dict) and message.get("type") == "pong":
            self.delay = self.heard_at - float(message["sent"])
        elif isinstance(message, dict) and message.get("type") == "hello":
            self.client = message.get("id", 0)
        else:
            self._receive(self, message)

    def _shake_hands(self, message: Any) -> None:
        """Prove to have the robot's key, and check its proof."""
        kind = message.get("type") if isinstance(message, dict) else None
        if kind == "challenge":
            self._answer(message)
        elif kind == "proof" and self._claimed and proves(message.get("proof"), self._fleet.key_of(self._claimed),
                                                          ROBOT, self._fleet.name, self._claimed, self._nonces):
            self.robot, self.problem, self.version = self._claimed, None, str(message.get("version", ""))[:40]
        else:
            self.problem = say("forged", address=self.address, robot=self._claimed)
            self._ended.set()

    def _answer(self, challenge: dict) -> None:
        robot, class_name = str(challenge.get("robot")), challenge.get("class")
        self._nonces, self.instance = Nonces(str(challenge.get("nonce")), new_nonce()), str(challenge.get("instance"))
        if not ROBOT_NAME.fullmatch(robot) or class_name != self._fleet.name:
            self.problem = say("other_fleet", address=self.address)
            self._ended.set()
            return
        self._claimed, self.problem = robot, say("wrong_key", robot=robot)  # until it proves the same
        self.send({"type": "answer", "nonce": self._nonces.hub,
                   "proof": proof(self._fleet.key_of(robot), HUB, self._fleet.name, robot, self._nonces)})


def as_object(text: str) -> dict:
    """Return the JSON object that this is, or an empty one."""
    try:
        fields = json.loads(text)
    except (ValueError, RecursionError):
        fields = None
    return fields if isinstance(fields, dict) else {}
