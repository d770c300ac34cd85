"""The processes above this one: roslaunch, with which the node ends, and a terminal, which may be suspended."""

# ruff: noqa: E402
import os

PARENT = os.getppid()  # before all imports that take a while: roslaunch may be killed meanwhile

import contextlib
import functools
import sys
from typing import BinaryIO, Dict

LAUNCHED = any(argument.startswith("__log:=") for argument in sys.argv)  # roslaunch adds this argument

STAT_SIZE = 200  # bytes; state and parent are among the first
STOPPED = "T"  # a state of proc(5): by SIGSTOP or Ctrl-Z, not by a debugger


class Launcher:
    """What has become of the processes above; ``poll`` reads it again. Where /proc cannot be read, nothing has.

    ended: whether roslaunch has started this process, and has ended; suspended: whether a process above is stopped.
    """

    def __init__(self, parent: int = PARENT, launched: bool = LAUNCHED):
        self._parent, self._launched = parent, launched
        self._roslaunch = next(filter(runs_python, ancestors()), parent)  # a launch-prefix such as xterm may be below
        self.poll()

    def poll(self) -> None:
        chain = ancestors()
        self.suspended = STOPPED in chain.values()
        self.ended = self._launched and (os.getppid() != self._parent or 1 in chain and self._roslaunch not in chain)


def ancestors() -> Dict[int, str]:
    """Return the ids of the processes above this one, the parent first, with their states by proc(5)."""
    chain, pid = {}, os.getppid()
    try:
        while pid:
            state, parent = os.pread(stat_file(pid).fileno(), STAT_SIZE, 0).rpartition(b")")[2].split()[:2]
            chain[pid] = state.decode()
            pid = int(parent)
    except (OSError, ValueError):  # it has just ended, or there is no /proc
        stat_file.cache_clear()
    return chain


@functools.lru_cache(maxsize=100)  # to open it takes longer than all the rest, four times a second
def stat_file(pid: int) -> BinaryIO:
    return open(f"/proc/{pid}/stat", "rb", buffering=0)


def runs_python(pid: int) -> bool:
    """Return whether a process runs Python, as roslaunch and a script with its API do."""
    with contextlib.suppress(OSError), open(f"/proc/{pid}/cmdline", "rb") as cmdline:
        return b"python" in cmdline.read().partition(b"\0")[0]
    return False
