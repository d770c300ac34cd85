"""A page of a hub or of a robot, by docs/protocol.md."""

import contextlib
import itertools
import random
import socket
import threading
import time
from typing import List, Optional, Tuple

from network import Host

from jetbot.wait import wait_until
from jetbot_ros.contract import COCKPIT_PORT
from web_client import Closed, WebSocket, page_headers

COMMAND_INTERVAL = 0.05  # s
SILENCE_TIMEOUT = 3.0    # s
RETRY_INTERVAL = (0.75, 2.25)  # s
SPEEDS = [0.30 + 0.02 * step for step in range(16)]  # one after the other, so that the wheels tell which command it is


class Page:
    """A page on this host, which connects again by itself as www/link.js does.

    address: where it is served; cookie: of a pupil, or "" for this computer's own browser. state: the newest message of
    this kind, {} without a connection; said: all sentences for the person; commands: when which speed was sent.
    """

    def __init__(self, host: Host, address: str = "", cookie: str = ""):
        self._host, self._address, self._cookie = host, address, cookie
        self._state: dict = {}
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
        robot, self._driven = self._driven, None
        if robot:
            self.send(type="drive", robot=f"/{robot}", forward=0.0, left=0.0)

    @property
    def presses(self) -> bool:
        return self._driven is not None

    @property
    def state(self) -> dict:
        return self._state

    def robot(self, name: str) -> dict:
        """Return the state of a robot, {} without a connection."""
        return self._state.get("robots", {}).get(f"/{name}", {})

    def wait(self, condition, within: float, what: str) -> float:
        """Wait until the condition is true; return the s that it took. Raise AssertionError."""
        start = time.monotonic()
        assert wait_until(condition, within), f"waited {within} s for {what}; {self.said[-3:]}; state {self._state}"
        return time.monotonic() - start

    def close(self) -> None:
        """Vanish, as a killed browser does."""
        self._closed.set()
        with contextlib.suppress(OSError, AttributeError):
            self._socket.connection.shutdown(socket.SHUT_RDWR)

    def _stay_connected(self) -> None:
        while not self._closed.is_set():
            with contextlib.suppress(Closed, OSError, ValueError, IndexError, RuntimeError):
                self._socket = self._host.call(self._open)
                self._receive(self._socket)
            self._state, self._driven = {}, None
            if self._socket:
                self._socket.close()
            self._closed.wait(random.uniform(*RETRY_INTERVAL))

    def _open(self) -> WebSocket:
        own = {"Cookie": f"jetbot_cockpit_{COCKPIT_PORT}={self._cookie}"} if self._cookie else {}
        return WebSocket(COCKPIT_PORT, page_headers(COCKPIT_PORT, self._address or "localhost", **own), "",
                         self._address or "127.0.0.1", timeout=SILENCE_TIMEOUT)

    def _receive(self, connection: WebSocket) -> None:
        while not self._closed.is_set():
            message = connection.receive()
            if message["type"] == "state":
                self._state = message
            elif message["type"] in ("lift", "notice"):
                self.said.append(message)
            if message["type"] == "lift" and self.lets_go and message["robot"] == f"/{self._driven}":
                self.let_go()

    def _drive(self) -> None:
        for speed in itertools.cycle(SPEEDS):
            if self._closed.wait(COMMAND_INTERVAL):
                return
            robot = self._driven
            if robot:
                self.commands.append((time.monotonic(), speed))
                self.send(type="drive", robot=f"/{robot}", forward=speed, left=0.0)
