"""Stops the wheels when the process that drives them dies or hangs.

A process that is killed can no longer stop anything. So a second one does, the guard: ``process`` is what it runs.
Each Robot starts one, unless JETBOT_GUARD names the socket of a guard that runs already (``python3 -m jetbot.guard``).
"""

import os
import time
from functools import partial
from typing import Callable, Optional

from ..errors import GuardError
from ..wait import wait_until
from .peer import connect, spawn
from .process import HEARTBEAT

MAX_STARTS = 3            # starts in a row without an answer until no further one is tried
RESTART_INTERVAL = 1.0    # s
WAIT_TIMEOUT = 5.0        # s


class Guard:
    """The driving process's side of its guard, which it replaces if that is killed or hangs. All but ``wait`` is quick.

    board: a name in ``boards.BOARDS``; place: as ``connection.locate`` returns it; address: its I2C address, None for
    the board's own.
    Raises GuardError if no guard can be started, but does not wait for it.
    """

    def __init__(self, board: str, place: str, address: Optional[int] = None):
        listener = os.environ.get("JETBOT_GUARD")
        if listener:
            self._open = partial(connect, listener, board, place, address)
            self._advice = f"Start the guard that listens on {listener}, or unset JETBOT_GUARD."
        else:
            self._open = partial(spawn, board, place, address)
            self._advice = "Close other programs, then start this one again."
        self._peer, self._problem, self._starts = None, "", 0
        self._start()
        if self._peer is None:
            raise self._error()

    def is_up(self) -> bool:
        """Return whether the guard is known to be up."""
        return self._peer.is_up()

    def renew(self) -> bool:
        """Return whether the guard is up; if it is lost, start another, at most one in a second.

        Raise GuardError after ``MAX_STARTS`` without an answer.
        """
        if self._peer.is_up():
            self._starts = 0
            return True
        if self._problem or self._peer.problem:
            if self._starts == MAX_STARTS:
                raise self._error()
            if time.monotonic() - self._started_at >= RESTART_INTERVAL:
                self._start()
        return False

    def wait(self, wanted: Callable[[], bool]) -> None:
        """Wait until the guard is up, or no longer ``wanted``. Raise GuardError if that takes too long."""
        if not wait_until(lambda: self.renew() or not wanted(), WAIT_TIMEOUT):
            self._problem = self._problem or "it does not answer"
            raise self._error()

    def heartbeat(self) -> None:
        """Feed the guard. Once fed, it must be fed again within a second. Raise GuardError if there is none."""
        self.renew()
        self._peer.ask(HEARTBEAT)

    def dismiss(self) -> None:
        """End the guard: the wheels are stopped."""
        self._peer.dismiss()

    def leave(self) -> None:
        """Leave it to the guard to stop the wheels."""
        self._peer.leave()

    def _start(self):
        self._starts, self._started_at = self._starts + 1, time.monotonic()
        if self._peer is not None:
            self._peer.dismiss(timeout=0)
        try:
            self._peer, self._problem = self._open(), ""
        except OSError as error:
            self._problem = error.strerror or str(error)

    def _error(self):
        return GuardError("the guard, which stops the wheels if this program dies, cannot be started: "
                          + (self._problem or self._peer.problem), self._advice)


class NoGuard:
    """In place of a Guard, for a robot that drives without one."""

    def is_up(self) -> bool:
        """Return True: there is nothing to wait for."""
        return True

    def heartbeat(self) -> None:
        """Do nothing."""

    dismiss = leave = heartbeat
