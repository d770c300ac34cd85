"""A page of a hub or of a robot, by docs/protocol.md."""

import contextlib
import itertools
import threading
import time
from typing import List, Optional, Tuple

from network import Host

from jetbot.wait import wait_until
from jetbot_ros.contract import COCKPIT_PORT
from web_client import Closed, WebSocket, page_headers

COMMAND_INTERVAL = 0.05  # s
PING_INTERVAL = 1.0      # s
SPEEDS = [0.30 + 0.02 * step for step in range(16)]  # one after the other, so that the wheels tell which command it is


class Page:
    """A page on this host. address: where it is served; cookie: of a pupil, or None for this computer's own browser.

    state: the newest message of this kind; said: all sentences for the person; commands: when which speed was sent.
    """

    def __init__(self, host: Host, address: str = "", cookie: str = ""):
        name = address or "localhost"
        own = {"Cookie": f"jetbot_cockpit_{COCKPIT_PORT}={cookie}"} if cookie else {}
        self._socket: WebSocket = host.call(WebSocket, COCKPIT_PORT, page_headers(COCKPIT_PORT, name, **own), "",
                                            address or "127.0.0.1")
        self.state: dict = {"robots": {}}
        self.said: List[dict] = []
        self.commands: List[Tuple[float, float]] = []
        self.is_open, self.lets_go = True, True
        self._driven: Optional[str] = None
        self._sending = threading.Lock()
        for work in self._receive, self._drive:
            threading.Thread(target=work, daemon=True).start()

    def send(self, **message: object) -> None:
        """Send a message; not if the socket is closed."""
        with self._sending, contextlib.suppress(OSError, ValueError):
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

    def robot(self, name: str) -> dict:
        """Return the state of a robot."""
        return self.state["robots"].get(f"/{name}", {})

    def wait(self, condition, within: float, what: str) -> float:
        """Wait until the condition is true; return the s that it took. Raise AssertionError."""
        start = time.monotonic()
        assert wait_until(condition, within), f"waited {within} s for {what}; state {self.state}; {self.said[-3:]}"
        return time.monotonic() - start

    def close(self) -> None:
        """Vanish, as a killed browser does."""
        self.is_open = False
        with contextlib.suppress(OSError):
            self._socket.connection.shutdown(2)

    def _receive(self) -> None:
        with contextlib.suppress(Closed, OSError, ValueError):
            while True:
                message = self._socket.receive()
                if message["type"] == "state":
                    self.state = message
                elif message["type"] in ("lift", "notice"):
                    self.said.append(message)
                if message["type"] == "lift" and self.lets_go and message["robot"] == f"/{self._driven}":
                    self.let_go()
        self.is_open = False
        self._socket.close()

    def _drive(self) -> None:
        for speed in itertools.cycle(SPEEDS):
            if not self.is_open:
                return
            robot = self._driven
            if robot:
                self.commands.append((time.monotonic(), speed))
                self.send(type="drive", robot=f"/{robot}", forward=speed, left=0.0)
            time.sleep(COMMAND_INTERVAL)
