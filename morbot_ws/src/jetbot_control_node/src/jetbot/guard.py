"""Stops the wheels when the process that drives them dies or hangs.

A process that is killed can no longer stop anything. So a second, small one reads from a pipe: the system closes it
when the driving process ends, however it ends, and unless that process has reported that the wheels are stopped, the
guard stops them.
"""

import contextlib
import os
import select
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Optional

from .boards import find_board
from .errors import BusError

STOPPED = b"s"
HEARTBEAT = b"h"
EOF = b""                 # read from a pipe that no process can write to any more
HEARTBEAT_TIMEOUT = 1.0   # s after a heartbeat until the driving process counts as hung, unless another one comes
RETRY_FOR = 600.0         # s to keep trying when the board does not answer
RETRY_INTERVAL = 0.2      # s
SHUTDOWN_TIMEOUT = 1.0    # s for the guard to end


class Guard:
    """The driving process's end of the pipe. board: a name in ``boards.BOARDS``; place: its ``Board.place``."""

    def __init__(self, board: str, place: str):
        code = f"import sys; sys.path = {sys.path}; from {__name__} import main; main(*sys.argv[1:])"
        self._command = [sys.executable, "-IS", "-c", code, board, place]
        self._start()

    def heartbeat(self) -> None:
        """Feed the guard. Once fed, it must be fed again within HEARTBEAT_TIMEOUT."""
        if self._process.poll() is not None:  # somebody killed the guard
            self._start()
        self._send(HEARTBEAT)

    def dismiss(self) -> None:
        """End the guard: the wheels are stopped."""
        self._send(STOPPED)
        self.leave()
        try:
            self._process.wait(SHUTDOWN_TIMEOUT)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def leave(self) -> None:
        """Leave it to the guard to stop the wheels."""
        self._process.stdin.close()

    def _start(self):
        self._process = subprocess.Popen(
            self._command, stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,  # else whatever reads this program's output would wait for the guard to end
            start_new_session=True)  # out of reach of Ctrl-C and of what ends the driving process's group
        os.set_blocking(self._process.stdin.fileno(), False)

    def _send(self, message):
        # OSError: it has just been killed, or hangs with the pipe full; ValueError: it was dismissed meanwhile
        with contextlib.suppress(OSError, ValueError):
            os.write(self._process.stdin.fileno(), message)


def main(board: str, place: str) -> None:
    """Run the guard: stop the wheels when the pipe is closed, and whenever heartbeats stop arriving."""
    for signum in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(signum, signal.SIG_IGN)
    Path("/proc/self/comm").write_text("jetbot_guard")  # so that killall python3 leaves it alive
    timeout = None  # a program need not send heartbeats; once it has, it must continue
    while True:
        message = read_message(timeout)
        if message == STOPPED:
            return
        if message == HEARTBEAT:
            timeout = HEARTBEAT_TIMEOUT
            continue
        stop(board, place)
        if message == EOF:
            return
        timeout = None


def read_message(timeout: Optional[float]) -> Optional[bytes]:
    """Return the newest message from the driving process; None after ``timeout`` seconds, EOF once it has ended."""
    if select.select([sys.stdin], [], [], timeout)[0]:
        return os.read(sys.stdin.fileno(), 4096)[-1:]
    return None


def stop(board: str, place: str) -> None:
    """Stop the wheels. If the board does not answer, report that once and try for ``RETRY_FOR`` seconds."""
    start, reported = time.monotonic(), False
    while time.monotonic() - start < RETRY_FOR:
        try:
            find_board(board).open(place).close()  # opening a board stops its wheels
            return
        except BusError as error:
            if not reported:
                reported = True
                with contextlib.suppress(OSError):
                    print(f"jetbot: the wheels may still turn. {error}", file=sys.stderr, flush=True)
            time.sleep(RETRY_INTERVAL)
