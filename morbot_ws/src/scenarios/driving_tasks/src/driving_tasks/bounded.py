"""Runs a function in a child process whose memory and time are limited: what a file holds can stop nothing else."""

import contextlib
import os
import pickle
import resource
import signal
from collections import deque
from typing import Any, Callable, Iterable, Iterator, NamedTuple, Tuple

from .child import FORK, address_space, end_with_parent, set_limits

MAX_ANSWER = 64 * 1024 * 1024  # bytes
POLL_INTERVAL = 0.1            # s


class Limits(NamedTuple):
    """memory: MB, beside what this process has; cpu_time, wall_time: s."""

    memory: int = 1000
    cpu_time: int = 20
    wall_time: float = 60.0


LIMITS = Limits()


class Outcome(NamedTuple):
    """What the function returned, or None and a problem in one sentence."""

    value: Any = None
    problem: str = ""


def run(function: Callable, *arguments: object, limits: Limits = LIMITS) -> Outcome:
    """Return the outcome of function(*arguments) in a child; what it returns must pickle.

    The child prints nothing and writes no file. It ends with this process, however that ends.
    """
    return next(run_each(function, [arguments], limits))


def run_each(function: Callable, calls: Iterable[Tuple], limits: Limits = LIMITS,
             at_once: int = 2) -> Iterator[Outcome]:
    """Yield the outcome of function(*arguments) for each call's arguments, in their order."""
    children = deque()
    try:
        for arguments in calls:
            children.append(_Child(function, arguments, limits))
            if len(children) == at_once:
                yield children.popleft().outcome()
        while children:
            yield children.popleft().outcome()
    finally:
        for child in children:
            child.kill()


class _Child:
    def __init__(self, function, arguments, limits):
        self._limits = limits
        self._pipe, answer = FORK.Pipe(duplex=False)
        self._process = FORK.Process(target=_work, args=(os.getpid(), answer, function, arguments, limits), daemon=True)
        signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT,))  # Ctrl-C is for this process
        try:
            self._process.start()
        finally:
            signal.pthread_sigmask(signal.SIG_UNBLOCK, (signal.SIGINT,))
        answer.close()

    def outcome(self) -> Outcome:
        """Wait for the child to end, and return its outcome."""
        try:
            # In steps, so that a process that was stopped for longer (Ctrl-Z) does not take that for the child's time.
            polls = round(self._limits.wall_time / POLL_INTERVAL)
            if not any(self._pipe.poll(POLL_INTERVAL) for _ in range(polls)):
                return Outcome(problem=f"It takes more than {self._limits.wall_time:g} s.")
            return pickle.loads(self._pipe.recv_bytes(MAX_ANSWER))
        except (EOFError, OSError):  # OSError: a longer answer
            self._process.join(1)
            return Outcome(problem=_reason(self._process.exitcode, self._limits))
        finally:
            self.kill()

    def kill(self) -> None:
        """End the child."""
        self._process.kill()
        self._process.join()
        self._pipe.close()


def _work(parent, answer, function, arguments, limits):
    """Answer with the outcome. This runs in the child."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    end_with_parent(parent, signal.SIGKILL)
    silent = os.open(os.devnull, os.O_RDWR)
    for stream in range(3):  # what a library prints may hold any character of the file
        os.dup2(silent, stream)
    set_limits({resource.RLIMIT_AS: address_space() + limits.memory * 10 ** 6,
                resource.RLIMIT_CPU: limits.cpu_time, resource.RLIMIT_FSIZE: 0})
    with contextlib.closing(answer):
        outcome = _outcome(function, arguments, limits)
        try:
            answer.send(outcome)
        except MemoryError:
            answer.send(Outcome(problem=_needs_memory(limits)))


def _outcome(function, arguments, limits):
    try:
        return Outcome(function(*arguments))
    except MemoryError:
        return Outcome(problem=_needs_memory(limits))
    except Exception as error:
        return Outcome(problem=str(error) or f"It cannot be read: {type(error).__name__}.")


def _needs_memory(limits):
    return f"It needs more than {limits.memory} MB of memory."


def _reason(exit_code, limits):
    """Return why a child gave no answer. exit_code: None for one that still runs."""
    if exit_code == -signal.SIGKILL:  # of the kernel, at the hard limit
        return f"It takes more than {limits.cpu_time} s of CPU time."
    if exit_code is None:
        return "Its result is too large."
    return f"{_needs_memory(limits)[:-1]}, or breaks the program that reads it."
