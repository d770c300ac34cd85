"""The processes above this one: roslaunch, with which the node ends, and a terminal, which may be suspended."""

# ruff: noqa: E402
import os

PARENT = os.getppid()  # before all imports that take a while: roslaunch may be killed meanwhile

import contextlib
import sys
from typing import List, NamedTuple

from jetbot.errors import EXHAUSTED, OutOfResources

LAUNCHED = any(argument.startswith("__log:=") for argument in sys.argv)  # roslaunch adds this argument

STOPPED = "T"  # a state of proc(5): by SIGSTOP or Ctrl-Z, not by a debugger


class Process(NamedTuple):
    """A process: its id, and its state by proc(5)."""

    pid: int
    state: str


class Launcher:
    """What has become of the processes above; ``poll`` reads it again. Where /proc cannot be read, nothing has.

    ended: whether roslaunch has started this process, and has ended; suspended: whether a process above is stopped.
    """

    def __init__(self, parent: int = PARENT, launched: bool = LAUNCHED):
        self._parent, self._launched = parent, launched
        chain = ancestors()
        self._roslaunch = next((process.pid for process in chain if runs_python(process.pid)), None)
        self._orphan = self._roslaunch is None and is_orphan(chain)
        self.poll()

    def poll(self) -> None:
        chain = ancestors()
        self.suspended = any(process.state == STOPPED for process in chain)
        self.ended = self._launched and (self._orphan or os.getppid() != self._parent or self._is_without(chain))

    def _is_without(self, chain):
        """Return whether roslaunch is missing in the chain; a launch-prefix such as xterm may be between."""
        pids = [process.pid for process in chain]
        return 1 in pids and self._roslaunch is not None and self._roslaunch not in pids


def is_orphan(chain: List[Process]) -> bool:
    """Return whether roslaunch, which is not in the chain, had ended before this process read its parent's id.

    A launch-prefix may have handed this process over to a terminal's program; then it has that terminal.
    """
    return bool(chain) and chain[-1].pid == 1 and not has_terminal()


def has_terminal() -> bool:
    """Return whether this process has a controlling terminal; roslaunch gives none to its nodes."""
    with contextlib.suppress(OSError), open("/dev/tty"):
        return True
    return False


def ancestors() -> List[Process]:
    """Return the processes above this one, the parent first, as far as this user can read them.

    Raise OutOfResources without a file descriptor: then no emergency stop could connect either.
    """
    chain, pid = [], os.getppid()
    try:
        while pid:
            with open(f"/proc/{pid}/stat", "rb", buffering=0) as stat:
                state, parent = stat.read().rpartition(b")")[2].split()[:2]
            chain.append(Process(pid, state.decode()))
            pid = int(parent)
    except OSError as error:  # it has just ended, or there is no /proc
        if error.errno in EXHAUSTED:
            raise OutOfResources(error) from None
    return chain


def runs_python(pid: int) -> bool:
    """Return whether a process runs Python, as roslaunch and a script with its API do."""
    with contextlib.suppress(OSError), open(f"/proc/{pid}/cmdline", "rb") as cmdline:
        return b"python" in cmdline.read().partition(b"\0")[0]
    return False
