"""A process of a scene, as Linux knows it."""

import contextlib
import os
import signal
import subprocess
from pathlib import Path
from typing import List, Tuple

from processes import end


class Process:
    """A process of the scene: ``kind`` is what it is; ``robot``: which it drives or commands."""

    def __init__(self, kind: str, popen: subprocess.Popen, command: Tuple[str, ...], robot: str = "", pid: int = 0):
        self.kind, self.popen, self.command, self.robot = kind, popen, command, robot
        self.pid = pid or popen.pid

    def __str__(self) -> str:
        return f"{self.kind} {self.robot}".strip()

    def alive(self) -> bool:
        """Return whether it runs, or is frozen."""
        return state(self.pid) not in "XZ"

    def runs(self) -> bool:
        return state(self.pid) not in "XZTt"

    def signal(self, signum: int) -> None:
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.pid, signum)

    def signal_all(self, signum: int) -> None:
        """Signal its whole group."""
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.pid, signum)

    def end(self) -> None:
        self.signal(signal.SIGCONT)
        end([self.popen])


def read(pid: object, name: str) -> str:
    """Return a file of /proc/PID, "" if the process has ended."""
    with contextlib.suppress(OSError):
        return Path(f"/proc/{pid}/{name}").read_text(errors="replace")
    return ""


def stat(pid: int) -> List[str]:
    """Return state and parent of a process by proc(5), X if it has ended."""
    return (read(pid, "stat").rpartition(")")[2].split() or ["X", "0"])[:2]


def state(pid: int) -> str:
    return stat(pid)[0]


def ancestors(pid: int) -> List[int]:
    """Return the ids of the processes above this one."""
    parent = int(stat(pid)[1])
    return [parent, *ancestors(parent)] if parent else []
