"""HTTP and WebSocket by hand: a client that can send what no browser sends."""

import json
import os
import socket
import struct
import time
from typing import Callable, Dict, NamedTuple, Optional, Tuple

TIMEOUT = 20.0  # s
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


def page_headers(port: int, name: str = "localhost", **headers: Optional[str]) -> Dict[str, str]:
    """Return the headers of a page that was opened by this name, and others: _ stands for -; None leaves one out."""
    host = f"{name}:{port}"
    given = {"Host": host, "Origin": f"http://{host}", **headers}
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
