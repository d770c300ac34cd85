"""Stops the wheels when the process that drives them dies or hangs.

A process that is killed can no longer stop anything. So a second one does, the guard: ``process`` is what it runs.
Each Robot starts one, unless JETBOT_GUARD names the socket of a guard that runs already (``python3 -m jetbot.guard``).
"""

import contextlib
import json
import os
import socket
import subprocess
import sys
import time
from typing import Callable, Optional, Tuple

from ..errors import GuardError
from ..host import peer_of
from ..wait import wait_until
from .process import ANSWER, EOF, HEARTBEAT, PING, STOPPED

PING_INTERVAL = 0.25      # s from an answer until the next is asked for
ANSWER_TIMEOUT = 0.7      # s without an answer until a guard that has answered before counts as lost
RESTART_INTERVAL = 1.0    # s
TIMEOUT = 10.0            # s without a guard
SHUTDOWN_TIMEOUT = 1.0    # s for the guard to end

PATH = [os.path.abspath(entry) for entry in sys.path]  # now: the program may change its folder later
CODE = f"""\
import socket, sys
sys.path = {PATH}
from {__name__}.process import serve
serve(socket.socket(fileno=0))"""


class Guard:
    """The driving process's side of its guard, which it replaces if that is killed or hangs. All but ``wait`` is quick.

    board: a name in ``boards.BOARDS``; place: as ``connection.locate`` returns it; address: its I2C address, None for
    the board's own.
    Raises GuardError if no guard can be started, but does not wait for it.
    """

    def __init__(self, board: str, place: str, address: Optional[int] = None):
        self._robot = json.dumps([board, place, address]).encode() + b"\n"
        self._listener = os.environ.get("JETBOT_GUARD")
        self._process: Optional[subprocess.Popen[bytes]] = None  # the guard's, if this program has started it
        self._missing_since: Optional[float] = None
        self._reason = "it does not answer"  # why there is none, while another one has not answered yet
        self._start()
        if self._problem:
            raise self._error()

    def is_up(self) -> bool:
        """Return whether the guard has answered and does not owe an answer for too long; ask it now and then."""
        if not self._problem:
            self._receive(time.monotonic())
        return self._up and not self._problem

    def wait(self, wanted: Callable[[], bool]) -> None:
        """Wait until the guard is up, or no longer ``wanted``. Raise GuardError after ``TIMEOUT``."""
        wait_until(lambda: self._renew() or not wanted(), 2 * TIMEOUT)

    def heartbeat(self) -> None:
        """Feed the guard. Once fed, it must be fed again within a second. Raise GuardError as ``wait`` does."""
        self._renew()
        self._ask(HEARTBEAT)

    def dismiss(self, timeout: float = SHUTDOWN_TIMEOUT) -> None:
        """End the guard: the wheels are stopped, or another guard takes over. Kill it after ``timeout`` seconds."""
        self._send(STOPPED)
        self.leave()
        if self._process is not None:
            try:
                self._process.wait(timeout)
            except subprocess.TimeoutExpired:
                self._process.kill()
                with contextlib.suppress(subprocess.TimeoutExpired):  # a stuck transfer ends before it does
                    self._process.wait(SHUTDOWN_TIMEOUT)

    def leave(self) -> None:
        """Leave it to the guard to stop the wheels."""
        self._connection.close()

    def _start(self) -> None:
        self._up, self._problem = False, ""
        self._started_at = self._answered_at = time.monotonic()
        self._asked_at: Optional[float] = self._started_at  # since when it owes an answer, or None
        try:
            if self._listener:
                self._connection = connect(self._listener)
            else:
                self._connection, self._process = spawn(self._robot.decode())
            self._connection.setblocking(False)
            self._send(self._robot)
        except OSError as error:
            self._problem = error.strerror or str(error)

    def _renew(self) -> bool:
        """Return whether the guard is up; if it is lost, start another, at most one in a second."""
        now = time.monotonic()
        if self.is_up():
            self._missing_since = None
            return True
        self._missing_since = self._missing_since or now
        if now - self._missing_since > TIMEOUT:
            self._missing_since = None
            self._problem = self._problem or self._reason
            raise self._error()
        if self._problem and now - self._started_at >= RESTART_INTERVAL:
            self._reason = self._problem
            self.dismiss(timeout=0)
            self._start()
        return False

    def _error(self) -> GuardError:
        advice = (f"Start the guard that listens on {self._listener}, or unset JETBOT_GUARD." if self._listener
                  else "Close other programs, then start this one again.")
        return GuardError("the guard, which stops the wheels if this program dies, cannot be started: "
                          f"{self._problem}", advice)

    def _ask(self, message: bytes) -> None:
        """Send a message that the guard answers."""
        if self._asked_at is None:
            self._asked_at = time.monotonic()
        self._send(message)

    def _send(self, message: bytes) -> None:
        # It has just been killed, was dismissed meanwhile, or hangs. No SIGPIPE: the program may have its own handler.
        with contextlib.suppress(OSError):
            self._connection.send(message, socket.MSG_NOSIGNAL)

    def _receive(self, now: float) -> None:
        try:
            answer = self._connection.recv(4096)
        except BlockingIOError:
            self._check_silence(now)
            return
        except OSError:  # it was killed before it has read everything
            answer = EOF
        if answer and not answer.strip(ANSWER):
            self._up, self._asked_at, self._answered_at = True, None, now
        else:
            self._problem = answer.strip(ANSWER).decode(errors="replace") or "it has ended"

    def _check_silence(self, now: float) -> None:
        if self._asked_at is None:
            if now - self._answered_at > PING_INTERVAL:
                self._ask(PING)
        elif self._up and now - self._asked_at > ANSWER_TIMEOUT:
            self._problem = "it does not answer"


class NoGuard:
    """In place of a Guard, for a robot that drives without one."""

    def is_up(self) -> bool:
        """Return True: there is nothing to wait for."""
        return True

    def heartbeat(self, *_: object) -> None:
        """Do nothing."""

    wait = dismiss = leave = heartbeat


def spawn(robot: str) -> Tuple[socket.socket, "subprocess.Popen[bytes]"]:
    """Start a guard process; return (the socket to it, the process). robot: for who lists processes. Raise OSError."""
    ours, theirs = socket.socketpair()
    with theirs:
        process = subprocess.Popen(
            [sys.executable, "-IS", "-c", CODE, robot], stdin=theirs.fileno(),
            stdout=subprocess.DEVNULL,  # else whatever reads this program's output would wait for the guard to end
            start_new_session=True)  # out of reach of Ctrl-C and of what ends the driving process's group
    return ours, process


def connect(path: str) -> socket.socket:
    """Return a socket to the guard that listens at this path; raise OSError, also if it is another user's."""
    connection = socket.socket(socket.AF_UNIX)
    connection.connect(path)
    require_own(connection)
    return connection


def require_own(connection: socket.socket) -> None:
    """Raise PermissionError unless the process at the other end of a unix socket belongs to this user."""
    _, user = peer_of(connection)
    if user != os.geteuid():
        raise PermissionError(f"it belongs to the user {user}")
