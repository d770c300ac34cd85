"""Runs what others wrote in a child process with limits: it stops nothing else, and leaves no process behind."""

import ctypes
import functools
import multiprocessing
import os
import resource
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any, Callable, List, NamedTuple

from jetbot.wait import wait_until

FORK = multiprocessing.get_context("fork")
MAX_PROCESSES = 200  # more than there are now; Linux does not limit root's
END_TIMEOUT = 10.0   # s in which all processes end, unless they multiply faster than they are killed
PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER = 1, 36  # of prctl(2)
prctl = ctypes.CDLL(None).prctl


class Limits(NamedTuple):
    """memory: MB, beside what this process has; file_size: MB, of each file that is written; the times in s.

    All but wall_time hold for each process that is started, too.
    """

    memory: int = 1000
    cpu_time: int = 20
    wall_time: float = 60.0
    file_size: int = 0


LIMITS = Limits()


class Outcome(NamedTuple):
    """What the function returned, or None and a problem in one sentence."""

    value: Any = None
    problem: str = ""


def run(function: Callable, *arguments: object, limits: Limits = LIMITS) -> Outcome:
    """Return the outcome of function(*arguments) in a child that prints nothing; what it returns must pickle.

    The child is in a session of its own: what is typed in the terminal goes to this process. It ends with this
    process, however that ends, and with it all that it has started.
    """
    pipe, answer = FORK.Pipe(duplex=False)
    child = FORK.Process(target=_work, args=(os.getpid(), answer, function, arguments, limits), daemon=True)
    child.start()
    answer.close()
    try:
        return pipe.recv() if pipe.poll(limits.wall_time) else Outcome(
            problem=f"It takes more than {limits.wall_time:g} s.")
    except (EOFError, OSError):
        child.join()
        return Outcome(problem=_reason(child.exitcode, limits))
    finally:
        child.terminate()
        child.join(END_TIMEOUT)
        child.kill()
        child.join()
        pipe.close()


def start(command: List[str], folder: Path, log: Path) -> subprocess.Popen:
    """Start a process in a folder, within a function that is run here. log: the file that gets its stderr."""
    with log.open("wb") as errors:
        return subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                stderr=errors, start_new_session=True,
                                preexec_fn=functools.partial(_end_with, os.getpid(), signal.SIGKILL))


def end_children() -> None:
    """Kill all children of this process, and those of theirs that it adopts meanwhile."""
    def ended():
        for child in children():
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, os.WNOHANG)
        return not children()

    wait_until(ended, END_TIMEOUT)


def children() -> List[int]:
    """Return the ids of this process's children, also of those that have ended and wait for it: proc(5)."""
    parents = {}
    for file in Path("/proc").glob("[0-9]*/stat"):
        try:
            parents[int(file.parent.name)] = int(file.read_text(errors="replace").rpartition(")")[2].split()[1])
        except OSError:  # it has just ended
            continue
    return [child for child, parent in parents.items() if parent == os.getpid()]


def _work(parent, answer, function, arguments, limits):
    """Send the outcome, once nothing is left of what the function started. This runs in the child."""
    os.setsid()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit())
    _end_with(parent, signal.SIGTERM)
    prctl(PR_SET_CHILD_SUBREAPER, 1)  # it adopts the orphans of its children
    silent = os.open(os.devnull, os.O_RDWR)
    for stream in range(3):  # what a library prints may hold any character of a file
        os.dup2(silent, stream)
    _limit(limits)
    try:
        _answer(answer, function, arguments, limits)
    finally:
        os._exit(0)  # also with threads, which have nothing left to do


def _answer(answer, function, arguments, limits):
    outcome = Outcome()
    try:
        outcome = Outcome(function(*arguments))
    except MemoryError:
        outcome = Outcome(problem=f"It needs more than {limits.memory} MB of memory.")
    except Exception as error:
        outcome = Outcome(problem=str(error) or f"It cannot be read: {type(error).__name__}.")
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_IGN)  # nothing interrupts the end
        end_children()
    answer.send(outcome)


def _end_with(parent, signum):
    """Let this process get a signal when its parent ends; end it now if that has ended already."""
    prctl(PR_SET_PDEATHSIG, signum)
    if os.getppid() != parent:
        os._exit(1)


def _limit(limits):
    """Limit this process, and all that it starts, for good."""
    memory = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    threads = int(Path("/proc/loadavg").read_text().split()[3].partition("/")[2])  # of all users: proc(5)
    for kind, value in ((resource.RLIMIT_CORE, 0), (resource.RLIMIT_CPU, limits.cpu_time),
                        (resource.RLIMIT_AS, memory + limits.memory * 10 ** 6),
                        (resource.RLIMIT_FSIZE, limits.file_size * 10 ** 6),
                        (resource.RLIMIT_NPROC, threads + MAX_PROCESSES)):
        highest = resource.getrlimit(kind)[1]
        value = value if highest == resource.RLIM_INFINITY else min(value, highest)
        resource.setrlimit(kind, (value, value))


def _reason(exit_code, limits):
    """Return why a child gave no answer."""
    if exit_code == -signal.SIGKILL:  # of the kernel, at the hard limit
        return f"It takes more than {limits.cpu_time} s of CPU time."
    return f"It needs more than {limits.memory} MB of memory, or breaks the program that reads it."
