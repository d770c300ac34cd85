"""The pictures that a child process writes to a pipe. The newest wins; a child that ends or hangs is started again."""

import contextlib
import os
import select
import signal
import subprocess
import sys
import threading
import time
from typing import Callable, Optional, Tuple

from ..errors import JetbotError
from ..wait import wait_until
from .jpeg import take
from .sources import Command

START_TIMEOUT = 10.0    # s for the first picture of a child
TIMEOUT = 5.0           # s from one picture to the next
END_TIMEOUT = 2.0       # s for a child to end: a camera's daemon may hang if its client is killed
RESTART_INTERVAL = 1.0  # s
REPEAT_AFTER = 60.0     # s until the same sentence is reported again
POLL_INTERVAL = 0.1     # s
CHUNK = 1024 * 1024     # bytes, more than a pipe holds: what is read at once is all there is
LAST_WORDS = 4000       # bytes of what a child has printed


def print_sentence(sentence: str) -> None:
    """Print to stderr."""
    print(f"jetbot: {sentence}", file=sys.stderr, flush=True)


class Stream:
    """The JPEGs of one source, read by a thread from ``start`` to ``stop``.

    report: is called with a sentence when no picture comes, from the thread.
    error: the JetbotError since the last picture, or None.
    """

    def __init__(self, command: Command, report: Callable[[str], None] = print_sentence):
        self._command, self._report, self.error = command, report, None
        self._changed = threading.Condition()
        self._number, self._newest = 0, b""
        self._stopping = threading.Event()
        self._process = None
        self._reported, self._reported_at = "", 0.0
        self._thread = threading.Thread(target=self._run, daemon=True)

    def start(self) -> None:
        """Start the child. A stream that was stopped cannot start again."""
        self._thread.start()

    def stop(self, wait: bool = True) -> None:
        """End the child; wait for that, a little more than END_TIMEOUT at most, unless told not to."""
        self._stopping.set()
        process = self._process
        if process is not None and process.returncode is None:
            send(process, signal.SIGINT)
        with self._changed:
            self._changed.notify_all()
        if wait and self._thread is not threading.current_thread():
            self._thread.join(END_TIMEOUT + 1.0)

    def next(self, number: int = 0) -> Optional[Tuple[int, bytes]]:
        """Wait for a picture that is newer than that with this number; return (its number, the JPEG).

        None once the stream is stopped. Before the first picture, a problem is raised.
        """
        with self._changed:
            self._changed.wait_for(lambda: self._number > number or self.error and not number
                                   or self._stopping.is_set())
            if self._stopping.is_set():
                return None
            if self._number == 0:
                raise self.error
            return self._number, self._newest

    def complain(self, error: JetbotError) -> None:
        """Keep an error, and report it, unless it has just been."""
        with self._changed:
            self.error = error
            self._changed.notify_all()
        now = time.monotonic()
        if str(error) != self._reported or now - self._reported_at > REPEAT_AFTER:
            self._reported, self._reported_at = str(error), now
            self._report(str(error))

    def _run(self):
        while not self._stopping.is_set():
            try:
                with child(self._command.line) as self._process:
                    error = self._read(self._process)
            except OSError as failure:
                error = self._command.explain(failure.strerror)
            if not self._stopping.is_set():
                self.complain(error)
            self._stopping.wait(RESTART_INTERVAL)

    def _read(self, process):
        """Return the error with which a child ends, or which makes its end necessary; None when it is stopped."""
        pictures, words, timeout = bytearray(), b"", START_TIMEOUT
        pipes, deadline = [process.stdout, process.stderr], time.monotonic() + timeout
        while not self._stopping.is_set():
            if time.monotonic() > deadline:
                return self._command.explain(words.decode(errors="replace")) if words else self._command.hung(timeout)
            for pipe in select.select(pipes, [], [], POLL_INTERVAL)[0]:
                data = os.read(pipe.fileno(), CHUNK)
                if pipe is process.stderr:
                    words = (words + data)[-LAST_WORDS:]
                    if not data:
                        pipes.remove(pipe)
                elif not data:
                    return self._command.explain((words + last_words(process.stderr)).decode(errors="replace"))
                elif self._publish(pictures, data):
                    timeout, deadline, words = TIMEOUT, time.monotonic() + TIMEOUT, b""
        return None

    def _publish(self, buffer, data):
        """Append what was read; return whether a picture is complete, the newest of which is published."""
        buffer += data
        newest = None
        for picture in iter(lambda: take(buffer), None):
            newest = picture
        if newest:
            with self._changed:
                self._number, self._newest, self.error = self._number + 1, newest, None
                self._changed.notify_all()
        return newest is not None


def last_words(pipe):
    """Return what a child that ends prints, without waiting for long."""
    return os.read(pipe.fileno(), LAST_WORDS) if select.select([pipe], [], [], POLL_INTERVAL)[0] else b""


@contextlib.contextmanager
def child(line):
    """Run a shell command in a group of its own, which ends with the context: interrupted first, then killed."""
    with subprocess.Popen(["sh", "-c", line], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          start_new_session=True) as process:
        try:
            yield process
        finally:
            process.stdout.close()  # it may wait for room in the pipe
            send(process, signal.SIGINT)
            wait_until(lambda: os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT | os.WNOHANG), END_TIMEOUT)
            send(process, signal.SIGKILL)  # all of its group


def send(process, signum):
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signum)
