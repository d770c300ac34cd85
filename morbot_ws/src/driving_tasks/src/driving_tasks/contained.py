"""Runs what others wrote in a child process with limits: it stops nothing else, and leaves no process behind."""

import contextlib
import ctypes
import functools
import multiprocessing
import os
import resource
import signal
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any, Callable, Collection, List, NamedTuple, Set

from jetbot.wait import wait_until

FORK = multiprocessing.get_context("fork")
MAX_PROCESSES = 200  # and threads, more than this user has when the child starts; Linux does not limit root's
END_TIMEOUT = 10.0   # s in which all processes end, unless they multiply faster than they are stopped
PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER = 1, 36  # of prctl(2)
CLONE_NEWNS, CLONE_NEWUSER, CLONE_NEWPID = 0x20000, 0x10000000, 0x20000000  # of unshare(2)
MS_REC, MS_PRIVATE = 0x4000, 0x40000  # of mount(2)
libc = ctypes.CDLL(None)


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
    process, however that ends, and with it all that it has started: see ``can_isolate``. If some of that cannot be
    ended, this is the problem, whatever the function returned.
    """
    others, used = children(), _cpu_time()
    pipe, answer = FORK.Pipe(duplex=False)
    child = FORK.Process(target=_work, args=(os.getpid(), answer, function, arguments, limits, can_isolate()),
                         daemon=True)
    libc.prctl(PR_SET_CHILD_SUBREAPER, 1)  # a child that is killed leaves its orphans to this process
    child.start()
    answer.close()
    try:
        outcome = pipe.recv() if pipe.poll(limits.wall_time) else Outcome(
            problem=f"It takes more than {limits.wall_time:g} s.")
    except (EOFError, OSError):
        child.join()
        outcome = Outcome(problem=_reason(_cpu_time() - used, limits))
    finally:
        pipe.close()
        _end(child)
        left = end_children(others)
        if not left:  # else what they leave still comes to this process
            libc.prctl(PR_SET_CHILD_SUBREAPER, 0)
    ids = " ".join(map(str, sorted(left)))
    return Outcome(problem=f"Some of its processes do not end. End them by hand: kill -9 {ids}") if left else outcome


@functools.lru_cache(None)
def can_isolate() -> bool:
    """Return whether a child may have a PID namespace of its own; in most containers it may not.

    Nothing there can reach a process outside, or end the namespace's first one, with which the kernel ends all others.
    Without it, what runs in a child ends unless it kills both the child and this process.
    """
    probe = FORK.Process(target=_probe)
    probe.start()
    probe.join()
    return probe.exitcode == 0


def start(command: List[str], folder: Path, log: Path) -> subprocess.Popen:
    """Start a process in a folder, within a function that is run here. log: the file that gets its stderr."""
    with log.open("wb") as errors:
        return subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                stderr=errors, start_new_session=True,
                                preexec_fn=functools.partial(_end_with, os.getpid(), signal.SIGKILL))


def end_children(others: Collection[int] = ()) -> Set[int]:
    """Kill all that descends from this process, but not these children, and what descends from them.

    Nothing is killed until all of it is stopped, as the rest would fill each gap at once. Returns the ids of what still
    runs after END_TIMEOUT.
    """
    stopped: Set[int] = set()

    def ended():
        nonlocal stopped
        found = _descendants(others)
        for process in found:
            with contextlib.suppress(OSError):  # it has ended meanwhile, or is no child of this process
                os.kill(process, signal.SIGKILL if found <= stopped else signal.SIGSTOP)
                os.waitpid(process, os.WNOHANG)
        stopped = found
        return not found

    return set() if wait_until(ended, END_TIMEOUT) else _descendants(others)


def children() -> List[int]:
    """Return the ids of this process's children, also of those that have ended and wait for it."""
    return [process for process, parent in _parents().items() if parent == os.getpid()]


def _descendants(others):
    """Return the ids of the children of this process but these, and of all that descend from them."""
    parents, found, last = _parents(), set(), {os.getpid()}
    while last:
        last = {process for process, parent in parents.items() if parent in last}.difference(others)
        found |= last
    return found


def _parents():
    """Return the parent of each process by its id: proc(5)."""
    parents = {}
    for process in map(int, filter(str.isdigit, os.listdir("/proc"))):
        with contextlib.suppress(OSError):  # it has just ended
            with open(f"/proc/{process}/stat", "rb") as file:  # beside a bomb of processes, each microsecond counts
                parents[process] = int(file.read().rpartition(b")")[2].split()[1])
    return parents


def _end(child):
    child.terminate()
    child.join(END_TIMEOUT)
    child.kill()
    child.join()


def _work(parent, answer, function, arguments, limits, is_isolated):
    """Send the outcome, once nothing is left of what the function started. This runs in the child."""
    os.setsid()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit())
    _end_with(parent, signal.SIGTERM)
    if is_isolated:
        _isolate()
    libc.prctl(PR_SET_CHILD_SUBREAPER, 1)  # it adopts the orphans of its children
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


def _probe():
    with contextlib.suppress(OSError):
        _isolate()
        os._exit(0)
    os._exit(1)


def _isolate():
    """Return in a child that is the first process of a PID namespace; this process only waits for it, and ends as well.

    Raises OSError, also in the child. See pid_namespaces(7), user_namespaces(7).
    """
    user, group = os.geteuid(), os.getegid()
    if libc.unshare(CLONE_NEWPID | CLONE_NEWNS):  # which root alone may
        if libc.unshare(CLONE_NEWUSER | CLONE_NEWPID | CLONE_NEWNS):
            raise PermissionError("no PID namespace")
        for file, line in ("setgroups", "deny"), ("uid_map", f"{user} {user} 1"), ("gid_map", f"{group} {group} 1"):
            Path("/proc/self", file).write_text(line)
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGTERM])  # it must reach the child
    first = os.fork()
    if first:
        def forward(*_):
            with contextlib.suppress(ProcessLookupError):  # it has just ended
                os.kill(first, signal.SIGTERM)
        signal.signal(signal.SIGTERM, forward)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGTERM])
        os._exit(os.WEXITSTATUS(os.waitpid(first, 0)[1]))
    libc.prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGTERM])
    if libc.mount(None, b"/", None, MS_REC | MS_PRIVATE, None) or libc.mount(b"proc", b"/proc", b"proc", 0, None):
        raise PermissionError("no /proc of its own")


def _end_with(parent, signum):
    """Let this process get a signal when its parent ends; end it now if that has ended already."""
    libc.prctl(PR_SET_PDEATHSIG, signum)
    if os.getppid() != parent:
        os._exit(1)


def _limit(limits):
    """Limit this process, and all that it starts, for good."""
    memory = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    for kind, value in ((resource.RLIMIT_CORE, 0), (resource.RLIMIT_CPU, limits.cpu_time),
                        (resource.RLIMIT_AS, memory + limits.memory * 10 ** 6),
                        (resource.RLIMIT_FSIZE, limits.file_size * 10 ** 6),
                        (resource.RLIMIT_NPROC, _count_threads() + MAX_PROCESSES)):
        value = _at_most(value, kind)
        resource.setrlimit(kind, (value, value))


def _at_most(value, kind):
    """Return the value of a limit, or what this process may have at most."""
    highest = resource.getrlimit(kind)[1]
    return value if highest == resource.RLIM_INFINITY else min(value, highest)


def _count_threads():
    """Return how many threads this user has by the kernel's count, which includes what a container cannot see; root: 0.

    It is the lowest limit that lets one more start: getrlimit(2). This changes the soft limit.
    """
    all_users = int(Path("/proc/loadavg").read_text().split()[3].partition("/")[2])  # proc(5)
    low, high = 0, _at_most(all_users, resource.RLIMIT_NPROC)
    while low < high:
        middle = (low + high) // 2
        try:
            resource.setrlimit(resource.RLIMIT_NPROC, (middle, resource.getrlimit(resource.RLIMIT_NPROC)[1]))
            thread = threading.Thread(target=int)
            thread.start()
            thread.join()
            high = middle
        except RuntimeError:  # it cannot start
            low = middle + 1
    return low


def _cpu_time():
    """Return the CPU time of all children that have ended, in s."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def _reason(cpu_time, limits):
    """Return why a child that used so much CPU time gave no answer."""
    if round(cpu_time) >= limits.cpu_time:  # the kernel counts in ticks
        return f"It takes more than {limits.cpu_time} s of CPU time."
    return f"It needs more than {limits.memory} MB of memory, or breaks what reads or runs it."
