"""The one place that ends a process in which something broke. Install it first: a start may fail for lack of memory.

A node that goes on without one of its threads may be deaf to an emergency stop. So an exception that ends a thread, and
one of rospy's threads that has ended, end the process. Before that, what it drives is stopped; after it, its guard does
that.
"""

import contextlib
import errno
import logging
import os
import select
import sys
import threading
import time
from typing import Callable, List

LACKS = (errno.ENOMEM, errno.ENFILE, errno.EMFILE, errno.ENOSPC, errno.EAGAIN)
WORDS = ("start new thread", "failed to map", "annot allocate", "Too many open files")  # of errors without a number
ADVICE = "Is this computer out of memory, processes, file descriptors or disk space?"

REPORT_TIMEOUT = 1.0  # s, more than ``before_end`` takes in a node that leaves

before_end: List[Callable[[], None]] = []  # called before the process ends; each may take a moment
_advice = [ADVICE]
_ending, _unwritten = threading.Event(), threading.Event()


def install(advice: str = ADVICE) -> None:
    """From now on, end this process when something in it breaks. Call it before other imports: those may fail, too."""
    _advice[:] = [advice]
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # numpy, which rospy imports, would start one for each core
    threading.excepthook = _thread_has_failed
    sys.excepthook = _program_has_failed
    logging.Handler.handleError = _log_has_failed


def lasting(function: Callable, is_over: Callable[[], bool]) -> Callable:
    """Return the function of a thread; if it returns before ``is_over``, the process ends."""
    def run(*arguments):
        try:
            function(*arguments)
        finally:
            if not is_over():
                end(f"{function.__qualname__} has ended")
    return run


def end(reason: object) -> None:
    """Report the reason in one line, and end this process."""
    if _ending.is_set():
        return
    _ending.set()
    try:
        for act in before_end:
            with contextlib.suppress(Exception):
                act()
        _print(f"[FATAL] {os.path.basename(sys.argv[0])} ends: {reason}.", *_advice)
    finally:
        os._exit(1)


def leave(code: int) -> None:
    """End this process now, with 1 if something in it broke: the thread that reports that ends it."""
    if _ending.is_set():
        time.sleep(REPORT_TIMEOUT)
    os._exit(1 if _ending.is_set() else code)


def is_lack(error: BaseException) -> bool:
    """Return whether the error says that this computer, or this process, lacks memory, threads, files or disk space."""
    return (isinstance(error, (MemoryError, SystemError)) or getattr(error, "errno", None) in LACKS
            or isinstance(error, (ImportError, RuntimeError)) and any(words in str(error) for words in WORDS))


def _thread_has_failed(failure):
    if failure.exc_type is not SystemExit:
        end(f"a thread has failed, {_described(failure.exc_value)}")


def _program_has_failed(kind, error, traceback):
    """Report a lack of resources in one line; anything else as Python does."""
    if is_lack(error):
        end(_described(error))
    sys.__excepthook__(kind, error, traceback)


def _log_has_failed(handler, record):
    """Report once that a log file cannot be written, as on a full disk, and not for each line."""
    if not _unwritten.is_set():
        _unwritten.set()
        _print(f"[WARN] the log cannot be written: {_described(sys.exc_info()[1])}")


def _described(error):
    return f"{type(error).__name__}: {error}" if str(error) else type(error).__name__


def _print(*words):
    with contextlib.suppress(OSError, ValueError):
        if select.select([], [2], [], 0)[1]:  # else nobody reads: a full pipe, a terminal after Ctrl-S
            os.write(2, f"{' '.join(words)}\n".encode(errors="replace"))
