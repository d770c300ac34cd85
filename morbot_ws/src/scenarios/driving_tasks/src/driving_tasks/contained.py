"""Processes of a folder of their own that leave nothing behind, whatever they start and however they end."""

import contextlib
import os
import resource
import signal
import subprocess
from pathlib import Path
from typing import Callable, Dict, Iterator, List, NamedTuple, Sequence, Set

from jetbot.wait import wait_until

from .child import end_with_parent, set_limits

MEMORY = 2000         # MB, of each process of a program
FILE_SIZE = 10        # MB, of each file that it writes
END_TIMEOUT = 1.0     # s from SIGTERM to SIGKILL
KILL_TIMEOUT = 10.0   # s in which all processes end, unless they multiply faster than they are killed
MAX_PROCESSES = 200   # more than this user has now; Linux does not limit root's


class Process(NamedTuple):
    """A process, by proc(5); user: the id of its user."""

    pid: int
    user: int
    state: str
    parent: int
    threads: int


def start(command: Sequence[str], folder: Path, environment: Dict[str, str], log: Path,
          limit: Callable[[], None] = lambda: None) -> subprocess.Popen:
    """Start a process in a session of its own, which ends with this one. log: the file that gets its stderr."""
    parent = os.getpid()

    def prepare():
        end_with_parent(parent, signal.SIGKILL)
        limit()

    with log.open("wb") as errors:
        return subprocess.Popen(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, preexec_fn=prepare,
                                stdout=subprocess.DEVNULL, stderr=errors, start_new_session=True)


def program_limiter(cpu_time: int) -> Callable[[], None]:
    """Return what limits the process that calls it. cpu_time: s, of each process that it starts too."""
    limits = {resource.RLIMIT_CPU: cpu_time, resource.RLIMIT_AS: MEMORY * 10 ** 6,
              resource.RLIMIT_FSIZE: FILE_SIZE * 10 ** 6, resource.RLIMIT_NPROC: threads_of_user() + MAX_PROCESSES}
    return lambda: set_limits(limits)


def end_program(process: subprocess.Popen) -> None:
    """End the process and its group, by SIGKILL if SIGTERM is not enough."""
    for signum in (signal.SIGTERM, signal.SIGKILL):
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signum)
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(END_TIMEOUT)


def end_children() -> None:
    """Kill all children of this process, and those that it adopts meanwhile."""
    def ended():
        for child in children():
            with contextlib.suppress(ProcessLookupError):
                os.kill(child.pid, signal.SIGKILL)
        with contextlib.suppress(ChildProcessError):
            while os.waitpid(-1, os.WNOHANG)[0]:
                pass
        return not children()

    wait_until(ended, KILL_TIMEOUT)


def children() -> List[Process]:
    """Return the processes whose parent is this one, also zombies: one whose threads still end has children."""
    return [process for process in processes() if process.parent == os.getpid()]


def running_children() -> Set[int]:
    """Return the ids of the children that have not ended."""
    return {child.pid for child in children() if child.state != "Z"}


def processes() -> Iterator[Process]:
    """Yield all processes of this computer that can be read."""
    for folder in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):  # it has just ended
            words = (folder / "stat").read_text(errors="replace").rpartition(")")[2].split()
            yield Process(int(folder.name), folder.stat().st_uid, words[0], int(words[1]), int(words[17]))


def threads_of_user() -> int:
    """Return how many threads this user has, which RLIMIT_NPROC counts."""
    return sum(process.threads for process in processes() if process.user == os.getuid())
