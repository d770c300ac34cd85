"""Stops the wheels when the process that drives them dies, however it dies.

A process that is killed can no longer stop anything. So a second, small one waits on a pipe: the system closes the
pipe when the driving process ends, and unless that one has said that it stopped the wheels, the guard does.
"""

import signal
import subprocess
import sys
import time

from .boards import open_board
from .errors import BusError

ALL_STOPPED = b"stopped"
PATIENCE = 10.0  # seconds to go on trying when the board does not answer


class Guard:
    """The driving process's end of the pipe."""

    def __init__(self, board, i2c_bus):
        self._process = subprocess.Popen(
            [sys.executable, "-IS", "-c", f"import sys; sys.path = {sys.path}; from {__name__} import main; main()",
             board, str(i2c_bus)], stdin=subprocess.PIPE,
            start_new_session=True)  # out of reach of Ctrl-C and of what ends the driving process's group

    def dismiss(self):
        """End the guard: the wheels stand."""
        self._process.communicate(ALL_STOPPED)

    def take_over(self):
        """Leave it to the guard to stop the wheels."""
        self._process.stdin.close()


def main():
    """The guard's process: wait for the pipe's end, then stop the wheels if nobody did."""
    for ending in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(ending, signal.SIG_IGN)
    if sys.stdin.buffer.read() != ALL_STOPPED:
        stop(*sys.argv[1:], deadline=time.monotonic() + PATIENCE)


def stop(board, i2c_bus, deadline):
    """Stop the wheels, again and again until it succeeds or the deadline (monotonic seconds) is past."""
    while True:
        try:
            return open_board(board, i2c_bus).close()  # opening a board stops its wheels
        except BusError as error:
            if time.monotonic() > deadline:
                sys.exit(f"jetbot: the wheels may still turn. {error}")
            time.sleep(0.1)
