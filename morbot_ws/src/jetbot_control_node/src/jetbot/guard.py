"""Stops the wheels when the process that drives them dies or hangs.

A process that is killed can no longer stop anything. So a second, small one listens on a pipe: the system closes it
when the driving process ends, however it ends, and unless that one has said that the wheels stand, the guard stops
them.
"""

import contextlib
import os
import select
import signal
import subprocess
import sys
import time

from .boards import Options, open_board
from .errors import BusError

STANDING = b"s"
HEARTBEAT = b"h"
SILENCE = 1.0    # seconds without a heartbeat, after the first one, that mean that the driving process hangs
PATIENCE = 10.0  # seconds to go on trying when the board does not answer


class Guard:
    """The driving process's end of the pipe."""

    def __init__(self, board, options):
        self._process = subprocess.Popen(
            [sys.executable, "-IS", "-c", f"import sys; sys.path = {sys.path}; from {__name__} import main; main()",
             board, str(options.i2c_bus), options.port], stdin=subprocess.PIPE,
            start_new_session=True)  # out of reach of Ctrl-C and of what ends the driving process's group
        os.set_blocking(self._process.stdin.fileno(), False)

    def heartbeat(self):
        """Say that this process does not hang. Once said, it must be said again within SILENCE seconds."""
        with contextlib.suppress(OSError):  # the guard has ended, or hangs itself with the pipe full
            os.write(self._process.stdin.fileno(), HEARTBEAT)

    def dismiss(self):
        """End the guard: the wheels stand."""
        self._process.communicate(STANDING)

    def take_over(self):
        """Leave it to the guard to stop the wheels."""
        self._process.stdin.close()


def main():
    """The guard's process: stop the wheels at the pipe's end, and whenever heartbeats stay out."""
    for ending in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(ending, signal.SIG_IGN)
    word = patience = None
    while word != b"":
        word = hear(patience)
        if word == STANDING:
            return
        if word != HEARTBEAT:
            stop(*sys.argv[1:])
        patience = SILENCE if word == HEARTBEAT else None


def hear(patience):
    """The newest word from the driving process; None after ``patience`` seconds of silence, b"" at its end."""
    if select.select([sys.stdin], [], [], patience)[0]:
        return os.read(sys.stdin.fileno(), 4096)[-1:]
    return None


def stop(board, i2c_bus, port):
    """Stop the wheels; where the board does not answer, try again and again for some seconds."""
    deadline = time.monotonic() + PATIENCE
    while True:
        try:
            return open_board(board, Options(i2c_bus, port)).close()  # opening a board stops its wheels
        except BusError as error:
            if time.monotonic() > deadline:
                return print(f"jetbot: the wheels may still turn. {error}", file=sys.stderr)
            time.sleep(0.1)
