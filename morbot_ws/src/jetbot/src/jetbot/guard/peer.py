"""One guard, as the driving process sees it: a socket to it, and its process if this program has started it."""

import contextlib
import json
import os
import socket
import struct
import subprocess
import sys
import time
from typing import Optional

from .process import ANSWER, PING, STOPPED, main

ANSWER_TIMEOUT = 0.7      # s without an answer until a guard counts as lost
START_TIMEOUT = 10.0      # s without an answer until one that has never answered does
PING_INTERVAL = 0.25      # s from an answer until the next is asked for
SHUTDOWN_TIMEOUT = 1.0    # s for the guard to end

try:
    START_FOLDER = os.getcwd()  # of relative entries in sys.path; the program may change its folder later
except FileNotFoundError:
    START_FOLDER = "/"
PACKAGES = os.path.join(START_FOLDER, os.path.dirname(__file__), "..", "..")
CODE = """\
import socket, sys
connection = socket.socket(fileno=0)
try:
    sys.path = {path}
    from {module} import main
except BaseException as error:
    connection.send(ascii(error).encode())
    raise SystemExit(1)
main(connection, *sys.argv[1:])"""


class Peer:
    """A guard, from its start to its loss. ``problem``: why it is lost, or ""; a lost guard stays lost."""

    def __init__(self, connection: socket.socket, process: Optional[subprocess.Popen] = None):
        connection.setblocking(False)
        self._connection = connection
        self._process = process
        self._up = False
        self._asked_at = self._answered_at = time.monotonic()  # _asked_at: since when it owes an answer, or None
        self.problem = ""

    def is_up(self) -> bool:
        """Return whether the guard has answered and does not owe an answer for too long; ask it now and then."""
        if not self.problem:
            self._receive(time.monotonic())
        return self._up and not self.problem

    def ask(self, message: bytes) -> None:
        """Send a message that the guard answers."""
        if self._asked_at is None:
            self._asked_at = time.monotonic()
        self._send(message)

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

    def _send(self, message):
        # It has just been killed, was dismissed meanwhile, or hangs. No SIGPIPE: the program may have its own handler.
        with contextlib.suppress(OSError):
            self._connection.send(message, socket.MSG_NOSIGNAL)

    def _receive(self, now):
        try:
            answer = self._connection.recv(4096)
        except BlockingIOError:
            self._check_silence(now)
        except OSError:
            self.problem = "it was killed"
        else:
            self._note(answer, now)

    def _check_silence(self, now):
        if self._asked_at is None:
            if now - self._answered_at > PING_INTERVAL:
                self.ask(PING)
        elif now - self._asked_at > (ANSWER_TIMEOUT if self._up else START_TIMEOUT):
            self.problem = "it does not answer"

    def _note(self, answer, now):
        if answer.strip(ANSWER):
            self.problem = answer.strip(ANSWER).decode(errors="replace")
        elif answer:
            self._up, self._asked_at, self._answered_at = True, None, now
        else:
            self.problem = "it has ended"


def spawn(board: str, place: str, address: Optional[int]) -> Peer:
    """Start a guard process for the robot with this board at this place and I2C address. Raise OSError."""
    path = [os.path.join(START_FOLDER, entry) for entry in sys.path if isinstance(entry, str)] + [PACKAGES]
    code = CODE.format(path=ascii(path), module=main.__module__)
    ours, theirs = socket.socketpair()
    with theirs:
        try:
            process = subprocess.Popen(
                [sys.executable, "-IS", "-c", code, board, place, str(address or "")], stdin=theirs,
                stdout=subprocess.DEVNULL,  # else whatever reads this program's output would wait for the guard to end
                start_new_session=True)  # out of reach of Ctrl-C and of what ends the driving process's group
        except BaseException:
            ours.close()
            raise
    return Peer(ours, process)


def connect(path: str, board: str, place: str, address: Optional[int]) -> Peer:
    """Ask the guard that listens on the socket ``path`` to guard this robot. Raise OSError."""
    connection = socket.socket(socket.AF_UNIX)
    try:
        connection.connect(path)
        require_own(connection)
        connection.sendall(json.dumps([board, place, address]).encode() + b"\n")
    except BaseException:
        connection.close()
        raise
    return Peer(connection)


def require_own(connection: socket.socket) -> None:
    """Raise PermissionError unless the process at the other end of a unix socket belongs to this user."""
    credentials = connection.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, struct.calcsize("3i"))
    _, user, _ = struct.unpack("3i", credentials)
    if user != os.geteuid():
        raise PermissionError(f"it belongs to the user {user}")
