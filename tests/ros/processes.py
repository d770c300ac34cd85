"""Processes that end with the program that starts them, also if that one is killed. Without ROS."""

import contextlib
import ctypes
import os
import secrets
import signal
import socket
import subprocess
from glob import glob
from pathlib import Path
from typing import List, Tuple

SHUTDOWN_TIMEOUT = 45.0  # s, until a process has ended: roslaunch ends its nodes one after the other
PR_SET_PDEATHSIG = 1     # of prctl(2)
_prctl = ctypes.CDLL(None).prctl


def end_with_parent(signum: int = signal.SIGTERM) -> None:
    """Let the kernel send this process a signal when the thread that started it ends: a preexec_fn of Popen."""
    _prctl(PR_SET_PDEATHSIG, signum)


def end_on_sigterm() -> None:
    """Let SIGTERM raise KeyboardInterrupt, as Ctrl-C does, so that contexts and fixtures end what they started.

    Ctrl-C does so also where a shell has started the tests in the background, and they would ignore it.
    """
    for signum in (signal.SIGTERM, signal.SIGINT):
        signal.signal(signum, signal.default_int_handler)


def start(command: List[str], log: Path, **options) -> subprocess.Popen:
    """Start a process in a group of its own, which writes into this file. options: of subprocess.Popen."""
    with log.open("w") as file:
        process = subprocess.Popen(command, stdout=file, stderr=file, start_new_session=True,
                                   preexec_fn=end_with_parent, **options)
    process.log = log
    return process


def start_display(log: Path, *arguments: str) -> Tuple[subprocess.Popen, str]:
    """Start an X display without a screen; return its process and its name. arguments: of Xvfb."""
    reading, writing = os.pipe()
    process = start(["Xvfb", "-displayfd", str(writing), *arguments], log, pass_fds=[writing])
    os.close(writing)
    with os.fdopen(reading) as number:
        return process, f":{number.readline().strip()}"


def end(processes: List[subprocess.Popen], within: float = SHUTDOWN_TIMEOUT) -> None:
    """End the processes by SIGINT to their groups, those that take longer than this, in s, by SIGKILL."""
    running = [process for process in processes if process.poll() is None]
    for process in running:
        for signum in (signal.SIGCONT, signal.SIGINT):
            os.killpg(process.pid, signum)
    for process in running:
        try:
            process.wait(within)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()


def children(pid: int) -> List[int]:
    """Return the ids of the processes that a process has started, zombies too; none of a thread that ends meanwhile."""
    found: List[int] = []
    for file in glob(f"/proc/{pid}/task/*/children"):
        with contextlib.suppress(OSError):
            found += map(int, Path(file).read_text().split())
    return found


def free_port() -> int:
    """Return a TCP port of this computer that no program uses, nor is given to one that asks for any (32768 and up)."""
    while True:
        with contextlib.suppress(OSError), socket.socket() as probe:
            probe.bind(("", 10000 + secrets.randbelow(22768)))
            return probe.getsockname()[1]
