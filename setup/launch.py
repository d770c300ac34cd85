"""Runs roslaunch in this process; its last line is why a node has failed.

Signals, the terminal and the nodes behave as they do with roslaunch itself.
"""

import contextlib
import functools
import re
import signal
import sys
import threading
from typing import Callable, Iterator, List, Optional

import roslaunch.parent

from jetbot.text import printable

INTERRUPTED, TERMINATED, NO_READER = (128 + signum for signum in (signal.SIGINT, signal.SIGTERM, signal.SIGPIPE))
FATAL = re.compile(r"^\[rosout\]\[(?:CRITICAL|FATAL)\] \S+ \S+: (.*)", re.M)  # in rospy's log


def launch(words: List[str]) -> int:
    """Run roslaunch; return its exit code, 1 if a node that must run has failed."""
    failures = []
    roslaunch.parent.ROSLaunchParent = functools.partial(Parent, failures)
    sys.argv = ["roslaunch", *words]  # roslaunch reads the arguments there
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(TERMINATED))
    print("morbot: the workshop's scenario with a simulated robot; Ctrl-C ends it", flush=True)
    try:
        code = roslaunch.main(sys.argv)
    except SystemExit as end:
        code = end.code
    sys.stdout.flush()
    if failures:
        print(printable(failures[0]), file=sys.stderr)
    return 1 if failures else code or 0


class Parent(roslaunch.parent.ROSLaunchParent):
    """roslaunch, with a listener that appends to ``failures``."""

    def __init__(self, failures: List[str], *arguments, **options):
        super().__init__(*arguments, **options)
        self._failures = failures

    def _load_config(self):
        with ctrl_c_for_this_process_only():
            super()._load_config()

    def _start_pm(self):
        super()._start_pm()
        self.pm.add_process_listener(FailureListener(self.pm, self._failures))  # before any process starts

    def start(self, *arguments):
        with quiet_end(lambda: roslaunch.pmon._shutting_down):
            super().start(*arguments)


class FailureListener(roslaunch.pmon.ProcessListener):
    """Ends roslaunch when a node that must run fails, or any node that logs why, and appends that line."""

    def __init__(self, monitor, failures: List[str]):
        self._monitor, self._failures = monitor, failures

    def process_died(self, name: str, code: Optional[int]) -> None:
        """Called by roslaunch, with the exit code, or minus the signal."""
        process = self._monitor.get_process(name)
        reason = code and fatal_line(process)
        if code and (reason or process.required):
            cause = f"ended with exit code {code}" if code > 0 else f"was killed by signal {-code}"
            self._failures.append(f"[FATAL] [{name.rpartition('-')[0] or name}]: {reason or cause}")
            self._monitor.shutdown()


def fatal_line(process) -> Optional[str]:
    """Return what a node logged as its reason to end, or None. process: roslaunch's LocalProcess."""
    log = next((word[len("__log:="):] for word in process.args if word.startswith("__log:=")), "")
    try:
        with open(log, errors="replace") as file:
            lines = FATAL.findall(file.read().rpartition(f"pid[{process.pid}]")[2])  # an earlier start's are before
    except OSError:
        return None
    return lines[-1] if lines else None


@contextlib.contextmanager
def ctrl_c_for_this_process_only() -> Iterator[None]:
    """Ctrl-C ends this process; a command that it runs meanwhile inherits a blocked SIGINT, and prints no traceback."""
    threading.Thread(target=threading.Event().wait, daemon=True).start()  # does not block it
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)


@contextlib.contextmanager
def quiet_end(is_interrupted: Callable[[], bool]) -> Iterator[None]:
    """End the process without a traceback if nobody reads its output, or if Ctrl-C comes while the nodes start."""
    try:
        yield
    except BrokenPipeError:
        sys.exit(NO_READER)
    except Exception:
        if is_interrupted():  # then roslaunch misses what it has just ended
            sys.exit(INTERRUPTED)
        raise
