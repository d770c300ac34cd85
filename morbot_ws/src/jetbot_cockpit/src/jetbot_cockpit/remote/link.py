"""A hub's socket to one robot's cockpit, which connects again by itself. Times are monotonic seconds."""

import asyncio
import contextlib
import json
import math
import socket
import time
from collections import defaultdict, deque
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Callable, DefaultDict, Deque, Optional, Set, Tuple, Union

from tornado.httpclient import HTTPClientError, HTTPRequest
from tornado.iostream import StreamClosedError
from tornado.simple_httpclient import HTTPTimeoutError
from tornado.websocket import WebSocketClosedError, WebSocketError, websocket_connect

from ..notices import Notice, say
from ..session.messages import FROM_COCKPIT, problem_of
from ..web.access import authority, dialled
from .claims import is_own
from .fleet import Fleet
from .key import HUB, RELAYED, ROBOT, ROBOT_NAME, WRONG_KEY, new_nonce, proof, proves

OPEN_TIMEOUT = 2.0     # s for a connection, and for its handshake
SILENCE_TIMEOUT = 3.0  # s without a message: the link is cut off
RETRY_INTERVAL = 0.5   # s
PING_INTERVAL = 0.5    # s
FRESH = 1.5            # s without a message after which nothing that moves is sent: it would arrive late
MAX_MESSAGE = 512 * 1024  # bytes
MAX_RATE = 400         # messages a second: a robot that sends more is disconnected,
MAX_TEXT_RATE = 256 * 1024  # as is one that sends more characters a second; reading them keeps a stop waiting
WORK, WORK_SHARE = '{"type": "work"', 8  # answers about kept programs are large, and rare: an eighth of them counts
REFUSED_INTERVAL = 1.0  # s until a robot is asked again whose answer was refused
MAX_PINGS = 50  # that may be under way
MAX_DIGITS = 20
MAX_TEXT = 40          # characters of what a robot says of itself
LOST = (OSError, ValueError, HTTPClientError, HTTPTimeoutError, StreamClosedError, WebSocketClosedError,
        WebSocketError, asyncio.TimeoutError)  # ValueError: of an address that is none
REFUSALS = {WRONG_KEY: "wrong_key", RELAYED: "relayed"}
CHECKED = FROM_COCKPIT.keys() - {"state", "robots"}
OF_CLASS = {"robots", "state", "trail", "scene", "scores", "tasks", "cameras"}  # come with ``frames`` alone
UNCHECKED = "state", "robots", "work"  # by the receiver: another version of MorBot may send other fields of a robot
THIS_HUB = new_nonce()
LINKS: DefaultDict[str, Set[str]] = defaultdict(set)  # the ids of all links of this hub, by address
RESOLVERS = ThreadPoolExecutor(64)  # a name that nobody answers for keeps one of them busy for many seconds


class Link:
    """address: HOST:PORT; receive: is called with the link and each message, a dict or bytes, once ``robot`` is proven.

    accept: is called with the link when a robot has proven its name; returns whether it is wanted; frames: whether
    the messages OF_CLASS are wanted.
    robot: the name that the cockpit has proven, "" without a connection; client: this link's id there;
    instance: which start of the cockpit this is; version: of MorBot there, or ""; problem: why there is no connection,
    or None; delay: s for a message there and back, or None; answered: when the newest ping was sent that the robot has
    answered: it has done what was sent before that; host, port: where it was reached.
    """

    def __init__(self, address: str, fleet: Fleet, receive: Callable[["Link", Union[dict, bytes]], None],
                 accept: Callable[["Link"], bool] = lambda link: True, frames: bool = True):
        self.address, self._fleet, self._receive, self._accept, self._frames = address, fleet, receive, accept, frames
        self.robot, self.instance, self.version, self.client = "", "", "", 0
        self.problem: Optional[Notice] = None
        self.delay: Optional[float] = None
        self.heard_at = self.answered = -math.inf
        self._pings: Deque[float] = deque(maxlen=MAX_PINGS)  # when each was sent that has no answer yet
        self.host, self.port = "", 0
        self._connection: Any = None
        self._claimed = ""  # a name that is not proven yet
        self._count = self._size = 0  # of messages since the last ping, in all
        self._handshake: Tuple[dict, dict] = {}, {}  # the challenge and the answer
        self._ended, self._is_refused = asyncio.Event(), False
        self._id = new_nonce()
        LINKS[address].add(self._id)
        self._task = asyncio.ensure_future(self._run())

    def close(self) -> None:
        """End the connection for good."""
        LINKS[self.address].discard(self._id)
        self._task.cancel()
        self._drop()

    def reconnect(self) -> None:
        """Close the connection, and connect again at once: what waits in it would come late, or never."""
        self._drop()
        self._ended.set()

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

    def ping(self) -> None:
        """Ask the robot for an answer, see ``answered``."""
        self._pings.append(time.monotonic())
        self.send({"type": "ping", "sent": self._pings[-1]})

    def is_backlogged(self) -> bool:
        """Return whether something that was sent is still in this process."""
        return self._connection is None or self._connection.stream.writing()

    async def _run(self) -> None:
        while True:
            self._ended, self._is_refused = asyncio.Event(), False
            was_connected = False
            try:
                await self._connect()
                was_connected = True
                await self._stay_connected()
            except LOST:
                pass
            if not self._is_refused:
                self.problem = say("no_link", address=self.address)
            was_closed_here = was_connected and self._connection is None  # by ``reconnect``
            self._drop()
            await asyncio.sleep(REFUSED_INTERVAL if self._is_refused else 0 if was_closed_here else RETRY_INTERVAL)

    async def _connect(self) -> None:
        self.host, self.port = await asyncio.wait_for(resolve(self.address), OPEN_TIMEOUT)
        request = HTTPRequest(f"ws://{authority(self.host, self.port)}/hub",
                              connect_timeout=OPEN_TIMEOUT, request_timeout=OPEN_TIMEOUT)
        early: list = []  # what arrives before this task goes on

        def on_message(data):
            (self._on_message if self._connection else early.append)(data)
        self._connection = await asyncio.wait_for(websocket_connect(
            request, on_message_callback=on_message, max_message_size=MAX_MESSAGE), OPEN_TIMEOUT)
        self._connection.stream.set_nodelay(True)
        for data in early:
            self._on_message(data)

    async def _stay_connected(self) -> None:
        opened_at = self.heard_at = time.monotonic()
        while not self._ended.is_set():
            now = time.monotonic()
            if now - (self.heard_at if self.robot else opened_at) > SILENCE_TIMEOUT:
                return  # a robot that has proven nothing may talk as it likes
            self._count = self._size = 0
            if self.robot:
                self.ping()
            with contextlib.suppress(asyncio.TimeoutError):
                await asyncio.wait_for(self._ended.wait(), PING_INTERVAL)

    def _drop(self) -> None:
        connection, self._connection = self._connection, None
        self.robot, self._claimed, self.delay, self.answered = "", "", None, -math.inf
        self._pings.clear()
        if connection:
            connection.close()
            connection.stream.close()  # a close that is not answered lasts for minutes

    def _on_message(self, data: Union[str, bytes, None]) -> None:
        self._count += 1
        self._size += size(data)
        if data is None:
            self._on_close()
        elif not self._ended.is_set():
            is_too_much = self._count > MAX_RATE * PING_INTERVAL or self._size > MAX_TEXT_RATE * PING_INTERVAL
            try:
                if not is_too_much:
                    self._take(data)
            except RecursionError:  # a list in a list, and so on
                is_too_much = True
            if is_too_much:
                self._refuse(say("too_much", robot=self.robot or self.address))

    def _on_close(self) -> None:
        """The robot has closed the connection: of a handshake, it may have said why."""
        code = self._connection.close_code if self._claimed and not self.robot else None
        if code in REFUSALS:
            self._refuse(say(REFUSALS[code], robot=self._claimed, address=self.address))
        self._ended.set()

    def _take(self, data: Union[str, bytes]) -> None:
        self.heard_at = time.monotonic()
        message = data if isinstance(data, bytes) else as_object(data)
        if not self.robot:
            self._shake_hands(message)
        elif isinstance(message, bytes) or self._is_news(message):
            self._receive(self, message)

    def _is_news(self, message):
        """Return whether this is for the receiver; what is not of the documented form is for nobody."""
        kind = message.get("type")
        if kind == "pong" and message.get("sent") in self._pings:
            self.answered = message["sent"]
            self.delay = self.heard_at - self.answered
        elif kind == "hello" and type(message.get("id")) is int:
            self.client = message["id"]
        if kind in OF_CLASS and not self._frames:
            return False
        return kind in UNCHECKED or kind in CHECKED and not problem_of(message) and is_own(self.robot, message)

    def _shake_hands(self, message: Any) -> None:
        """Prove to have the robot's key, and check its proof."""
        kind = message.get("type") if isinstance(message, dict) else None
        if kind == "challenge":
            self._answer(message)
        elif kind == "proof" and self._claimed and proves(
                message.get("proof"), self._fleet.key_of(self._claimed), ROBOT, *self._handshake):
            self.robot, self.version = self._claimed, str(message.get("version", ""))[:MAX_TEXT]
            self.problem = None
            if not self._accept(self):
                self._refuse(self.problem)
        else:
            self._refuse(say("forged", address=self.address, robot=self._claimed or self.address))

    def _refuse(self, problem: Optional[Notice]) -> None:
        """Close the connection, and wait a while before the next one."""
        self.problem, self._is_refused = problem, True
        self.robot = ""
        self._ended.set()

    def _answer(self, challenge: dict) -> None:
        robot, class_name = str(challenge.get("robot")), challenge.get("class")
        self.instance = str(challenge.get("instance"))
        if not ROBOT_NAME.fullmatch(robot) or class_name != self._fleet.name:
            self._refuse(say("other_fleet", address=self.address))
            return
        self._claimed = robot
        answer = {"type": "answer", "nonce": new_nonce(), "address": dialled(self.host, self.port),
                  "frames": self._frames, "hub": THIS_HUB, "link": self._id, "links": sorted(LINKS[self.address])}
        self._handshake = challenge, answer
        self.send({**answer, "proof": proof(self._fleet.key_of(robot), HUB, *self._handshake)})


def size(data: Union[str, bytes, None]) -> float:
    """Return what a message adds to MAX_TEXT_RATE; a part of a picture, which is not read here, adds nothing."""
    if not isinstance(data, str):
        return 0
    return len(data) / (WORK_SHARE if data.startswith(WORK) else 1)


async def resolve(address: str) -> Tuple[str, int]:
    """Return the IP address and the port of HOST:PORT. Raises OSError or ValueError."""
    host, _, port = address.rpartition(":")
    found = await asyncio.get_event_loop().run_in_executor(
        RESOLVERS, lambda: socket.getaddrinfo(host.strip("[]"), int(port), type=socket.SOCK_STREAM))
    return found[0][4][0], int(port)


def as_object(text: str) -> dict:
    """Return the JSON object that this is, or an empty one."""
    try:
        fields = JSON.decode(text)
    except (ValueError, RecursionError):
        fields = None
    return fields if isinstance(fields, dict) else {}


def as_finite(text: str) -> float:
    """Return a number; raise ValueError for one that Python reads, and browsers do not."""
    number = float(text)
    if not math.isfinite(number):
        raise ValueError(f"{text[:MAX_TEXT]} is no JSON")
    return number


JSON = json.JSONDecoder(parse_float=as_finite, parse_constant=as_finite,
                        parse_int=lambda digits: int(digits[:MAX_DIGITS]))  # all of a long one would take long
