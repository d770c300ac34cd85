"""HTTP and WebSocket by hand: a client that can send what no browser sends."""

import contextlib
import itertools
import json
import os
import random
import socket
import struct
import threading
import time
from typing import Callable, Dict, List, NamedTuple, Optional, Sequence, Tuple

TIMEOUT = 20.0  # s
COMMAND_INTERVAL = 0.05  # s between two commands of a page that drives
UPGRADE = {"Upgrade": "websocket", "Connection": "Upgrade", "Sec-WebSocket-Version": "13",
           "Sec-WebSocket-Key": "x3JJHMbDL1EzLkh9GBhXDw=="}
TEXT, CLOSE, PING, PONG = 1, 8, 9, 10


class Answer(NamedTuple):
    """An answer to a request; the headers' names are in lower case."""

    status: int
    headers: Dict[str, str]
    body: bytes


class Closed(Exception):
    """The server has closed the WebSocket, with this code and reason; (None, "") without."""

    def __init__(self, code: Optional[int] = None, reason: str = ""):
        super().__init__(code, reason)
        self.code, self.reason = code, reason


def connect(port: int, phone: str = "127.0.0.1", host: str = "127.0.0.1", timeout: float = TIMEOUT) -> socket.socket:
    """Return a TCP connection to this port. phone: the address that it comes from, one that begins with 127, or ""."""
    return socket.create_connection((host, port), timeout, (phone, 0))


def listens(port: int) -> bool:
    """Return whether a program listens at this port of this computer."""
    with contextlib.suppress(OSError), connect(port):
        return True
    return False


def page_headers(port: int, name: str = "localhost", cookie: str = "", **headers: Optional[str]) -> Dict[str, str]:
    """Return the headers of a page that was opened by this name, and others: _ stands for -; None leaves one out.

    cookie: of a person, or "" for this computer's own browser.
    """
    host = f"{name}:{port}"
    own = {"Cookie": f"jetbot_cockpit_{port}={cookie}"} if cookie else {}
    given = {"Host": host, "Origin": f"http://{host}", **own, **headers}
    return {key.replace("_", "-"): value for key, value in given.items() if value is not None}


def head(method: str, path: str, headers: Dict[str, str]) -> bytes:
    """Return the head of a request."""
    lines = [f"{method} {path} HTTP/1.1", *(f"{name}: {value}" for name, value in headers.items()), "", ""]
    return "\r\n".join(lines).encode()


def request(port: int, method: str, path: str, headers: Dict[str, str], body: bytes = b"",
            phone: str = "127.0.0.1") -> Answer:
    """Send one request on a connection of its own; return the answer."""
    length = {"Content-Length": str(len(body))} if body else {}
    with connect(port, phone) as connection:
        connection.sendall(head(method, path, {**headers, **length, "Connection": "close"}) + body)
        return read_answer(connection.makefile("rb"))


def read_answer(file) -> Answer:
    """Return the answer in a file of bytes."""
    status = int(file.readline().split()[1])
    headers = {}
    for line in iter(file.readline, b"\r\n"):
        name, _, value = line.decode().partition(":")
        headers[name.lower()] = value.strip()
    body = b"" if status in (101, 204) else file.read(int(headers.get("content-length", 0)))
    return Answer(status, headers, body)


class WebSocket:
    """A page's socket, or another one. headers: of its request, such as Host, Origin and Cookie."""

    def __init__(self, port: int, headers: Dict[str, str], phone: str = "127.0.0.1", host: str = "127.0.0.1",
                 path: str = "/socket", timeout: float = TIMEOUT):
        self.connection = connect(port, phone, host, timeout)
        self._file = self.connection.makefile("rb")
        self.connection.sendall(head("GET", path, {**UPGRADE, **headers}))
        self.status = read_answer(self._file).status

    def send(self, message: object) -> None:
        """Send a message: bytes as they are, anything else as JSON."""
        self.send_frame(TEXT, message if isinstance(message, bytes) else json.dumps(message).encode())

    def send_frame(self, opcode: int, payload: bytes = b"") -> None:
        """Send one masked frame."""
        length = (bytes([0x80 | len(payload)]) if len(payload) < 126 else
                  struct.pack("!BH", 0xFE, len(payload)) if len(payload) < 65536 else
                  struct.pack("!BQ", 0xFF, len(payload)))
        mask = os.urandom(4)
        masked = bytes(byte ^ mask[index % 4] for index, byte in enumerate(payload))
        self.connection.sendall(bytes([0x80 | opcode]) + length + mask + masked)

    def receive(self, kind: str = "") -> dict:
        """Return the next message, of this type if one is given; answer pings meanwhile. Raise Closed."""
        while True:
            opcode, payload = self._receive_frame()
            if opcode == PING:
                self.send_frame(PONG, payload)
            elif opcode == CLOSE:
                raise Closed(struct.unpack("!H", payload[:2])[0] if payload else None, payload[2:].decode())
            elif opcode == TEXT and kind in ("", json.loads(payload)["type"]):
                return json.loads(payload)

    def receive_until(self, condition: Callable[[dict], object]) -> dict:
        """Return the first message for which the condition is true. Raise Closed."""
        deadline = time.monotonic() + TIMEOUT
        while time.monotonic() < deadline:
            message = self.receive()
            if condition(message):
                return message
        raise AssertionError(f"no such message within {TIMEOUT} s")

    def wait_for_close(self) -> Closed:
        """Return the code and the reason with which the server closes the socket."""
        try:
            self.receive_until(lambda message: False)
        except Closed as closed:
            return closed
        except ConnectionError:
            return Closed()

    def close(self) -> None:
        """Close the connection without a word, as a killed browser does."""
        self._file.close()
        self.connection.close()

    def _receive_frame(self) -> Tuple[int, bytes]:
        start = self._read(2)
        length = start[1] & 0x7F
        if length > 125:
            length = int.from_bytes(self._read(2 if length == 126 else 8), "big")
        return start[0] & 0x0F, self._read(length)

    def _read(self, count: int) -> bytes:
        data = self._file.read(count)
        if len(data) < count:
            raise Closed
        return data


def open_page(port: int, name: str = "localhost") -> WebSocket:
    """Return the socket of a page of this computer that was opened by this name."""
    return WebSocket(port, page_headers(port, name))


class Page:
    """A page that connects again by itself, as www/link.js does, and drives a robot while a finger presses.

    open_socket: connects; speeds: of its commands, in turn; retry_interval: the shortest and the longest, in s;
    presses_again: whether the finger presses again at once after a lift or a break; show: gets each sentence for the
    person. state: the newest message of this kind, {} without a connection; said: all sentences; commands: when which
    speed was sent.
    """

    def __init__(self, open_socket: Callable[[], WebSocket], speeds: Sequence[float],
                 retry_interval: Tuple[float, float], presses_again: bool = False,
                 show: Callable[[dict], object] = lambda sentence: None):
        self._open_socket, self._speeds, self._retry_interval = open_socket, speeds, retry_interval
        self._presses_again, self._show = presses_again, show
        self.state: dict = {}
        self.said: List[dict] = []
        self.commands: List[Tuple[float, float]] = []
        self.lets_go = True
        self._driven: Optional[str] = None
        self._socket: Optional[WebSocket] = None
        self._sending, self._closed = threading.Lock(), threading.Event()
        for work in self._stay_connected, self._drive:
            threading.Thread(target=work, daemon=True).start()

    def send(self, **message: object) -> None:
        """Send a message; not without a connection."""
        with self._sending, contextlib.suppress(OSError, ValueError, AttributeError):
            self._socket.send(message)

    def press(self, robot: str, lets_go: bool = True) -> None:
        """Drive a robot from now on. lets_go: whether the finger lifts when the cockpit asks for it."""
        self.lets_go, self._driven = lets_go, robot

    def let_go(self) -> None:
        """Lift the finger."""
        robot = self._driven
        self._driven = robot if self._presses_again else None
        if robot:
            self.send(type="drive", robot=f"/{robot}", forward=0.0, left=0.0)

    @property
    def presses(self) -> bool:
        return self._driven is not None

    def close(self) -> None:
        """Vanish, as a killed browser does."""
        self._closed.set()
        with contextlib.suppress(OSError, AttributeError):
            self._socket.connection.shutdown(socket.SHUT_RDWR)

    def _stay_connected(self) -> None:
        while not self._closed.is_set():
            with contextlib.suppress(Closed, OSError, ValueError, IndexError, RuntimeError):
                self._socket = self._open_socket()
                self._receive(self._socket)
            self.state = {}
            if self._socket:
                self._socket.close()
            self.let_go()
            self._closed.wait(random.uniform(*self._retry_interval))

    def _receive(self, connection: WebSocket) -> None:
        while not self._closed.is_set():
            message = connection.receive()
            if message["type"] == "state":
                self.state = message
            elif message["type"] in ("lift", "notice"):
                self.said.append(message)
                self._show(message)
            if message["type"] == "lift" and self.lets_go and message["robot"] == f"/{self._driven}":
                self.let_go()

    def _drive(self) -> None:
        for speed in itertools.cycle(self._speeds):
            if self._closed.wait(COMMAND_INTERVAL):
                return
            robot = self._driven
            if robot:
                self.commands.append((time.monotonic(), speed))
                self.send(type="drive", robot=f"/{robot}", forward=speed, left=0.0)
