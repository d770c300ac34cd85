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
from pathlib import Path

from .boards import Options, open_board
from .errors import BusError

STANDING = b"s"
HEARTBEAT = b"h"
END = b""          # what one reads from a pipe that nobody can write to any more
SILENCE = 1.0    # seconds without a heartbeat, after the first one, that mean that the driving process hangs
PATIENCE = 600.0  # seconds to go on trying when the board does not answer
PAUSE = 0.2       # seconds between two tries
FAREWELL = 1.0    # seconds for the guard to end


class Guard:
    """The driving process's end of the pipe; board: a row of ``boards.BOARDS``, options: its ``boards.Options``."""

    def __init__(self, board, options):
        self._command = [
            sys.executable, "-IS", "-c", f"import sys; sys.path = {sys.path}; from {__name__} import main; main()",
            board, str(options.i2c_bus), options.port, str(options.failsafe)]
        self.start()

    def start(self):
        """Start the guard's process."""
        self._process = subprocess.Popen(
            self._command, stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,  # else who reads this program's output would wait for the guard's end
            start_new_session=True)  # out of reach of Ctrl-C and of what ends the driving process's group
        os.set_blocking(self._process.stdin.fileno(), False)

    def is_alive(self):
        """Whether the guard's process runs."""
        return self._process.poll() is None

    def heartbeat(self):
        """Say that this process does not hang. Once said, it must be said again within SILENCE seconds."""
        self._say(HEARTBEAT)

    def dismiss(self):
        """End the guard: the wheels stand."""
        self._say(STANDING)
        self.leave()
        try:
            self._process.wait(FAREWELL)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def leave(self):
        """Leave it to the guard to stop the wheels."""
        self._process.stdin.close()

    def _say(self, word):
        # OSError: it has just been killed, or hangs with the pipe full; ValueError: it was dismissed meanwhile
        with contextlib.suppress(OSError, ValueError):
            os.write(self._process.stdin.fileno(), word)


def main():
    """The guard's process: stop the wheels at the pipe's end, and whenever heartbeats stay out."""
    for ending in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(ending, signal.SIG_IGN)
    Path("/proc/self/comm").write_text("jetbot_guard")  # so that killall python3 leaves it alive
    silence = None  # a program need not send heartbeats; once it has, they must not stay out
    while True:
        word = hear(silence)
        if word == STANDING:
            return
        if word == HEARTBEAT:
            silence = SILENCE
            continue
        stop(*sys.argv[1:])
        if word == END:
            return
        silence = None


def hear(silence):
    """The newest word from the driving process; None after this many seconds of silence, END at its end."""
    if select.select([sys.stdin], [], [], silence)[0]:
        return os.read(sys.stdin.fileno(), 4096)[-1:]
    return None


def stop(board, i2c_bus, port, failsafe):
    """Stop the wheels; where the board does not answer, say so once and try again and again for some minutes."""
    start, told = time.monotonic(), False
    while time.monotonic() - start < PATIENCE:
        try:
            options = Options(i2c_bus, port, float(failsafe))
            open_board(board, options).close()  # opening a board stops its wheels
            return
        except BusError as error:
            if not told:
                told = True
                with contextlib.suppress(OSError):
                    print(f"jetbot: the wheels may still turn. {error}", file=sys.stderr, flush=True)
            time.sleep(PAUSE)
