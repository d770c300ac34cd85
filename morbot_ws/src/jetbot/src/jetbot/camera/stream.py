"""The pictures that a child process writes to a pipe. The newest wins; a child that ends or hangs is started again."""

import contextlib
import os
import secrets
import select
import signal
import subprocess
import sys
import threading
import time
from collections import deque
from pathlib import Path
from typing import Any, Callable, Deque, Iterator, List, Optional

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
# Reads the id of a group, then waits for the end of this process, which closes the pipe, and ends the group.
WATCH = ["sh", "-c", 'read group || exit; read _; kill -INT "-$group"; sleep "$0"; kill -KILL "-$group"',
         str(END_TIMEOUT)]


def print_sentence(sentence: str) -> None:
    """Print to stderr."""
    print(f"jetbot: {sentence}", file=sys.stderr, flush=True)


class Stream:
    """The pictures of one source, read by a thread from ``start`` to ``stop``; iterate to follow them.

    report: is called with a sentence when no picture comes, from the thread.
    decode: makes a picture of a JPEG, in the thread; raises JetbotError for one that is left out.
    newest: the newest picture, None before the first; count: how many there were.
    error: the JetbotError since the last picture, or None.
    """

    def __init__(self, command: Command, report: Callable[[str], None] = print_sentence,
                 decode: Callable[[bytes], Any] = bytes):
        self._command, self._report, self._decode = command, report, decode
        self.newest, self.count = None, 0
        self.error: Optional[JetbotError] = None
        self._changed = threading.Condition()
        self._stopping = threading.Event()
        self._process: Optional[subprocess.Popen[bytes]] = None
        self._reported, self._reported_at = "", 0.0
        self._thread = threading.Thread(target=self._run, daemon=True)

    def start(self) -> None:
        """Start the child. A stream that was stopped cannot start again."""
        self._thread.start()

    def stop(self) -> None:
        """End the child, and wait for that, a little more than END_TIMEOUT at most."""
        self._interrupt()
        if self._thread is not threading.current_thread():
            self._thread.join(END_TIMEOUT + 1.0)

    def abandon(self) -> None:
        """End the child, which may outlive this process by END_TIMEOUT; do not wait."""
        self._interrupt()

    def require_picture(self) -> None:
        """Wait for the first picture. Raise the JetbotError of a child that ends or hangs before."""
        with self._changed:
            self._changed.wait_for(lambda: self.count or self.error or self._stopping.is_set())
            if self.error and not self.count:
                raise self.error

    def __iter__(self) -> Iterator[Any]:
        """Yield the newest picture, then each that is the newest when it is asked for, until the stream is stopped."""
        count = 0
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self.count > count or self._stopping.is_set())  # noqa: B023
                if self._stopping.is_set():
                    return
                count, picture = self.count, self.newest
            yield picture

    def complain(self, error: JetbotError) -> None:
        """Report an error, unless it has just been."""
        now = time.monotonic()
        if str(error) != self._reported or now - self._reported_at > REPEAT_AFTER:
            self._reported, self._reported_at = str(error), now
            self._report(str(error))

    def _interrupt(self) -> None:
        """Let the thread end; interrupt the child."""
        with self._changed:
            self._stopping.set()
            self._changed.notify_all()
        if self._process is not None and self._process.returncode is None:
            send(self._process, signal.SIGINT)

    def _run(self) -> None:
        while not self._stopping.is_set():
            try:
                with child(self._command.line) as self._process:
                    error = self._read(Output(self._process))
            except OSError as failure:
                error = self._command.explain(b"", failure.strerror or str(failure))
            if not self._stopping.is_set():
                self._set(error=error)
                self.complain(error)
            self._stopping.wait(RESTART_INTERVAL)

    def _read(self, output: "Output") -> JetbotError:
        """Return the error with which a child ends, or which makes its end necessary."""
        timeout, deadline = START_TIMEOUT, time.monotonic() + START_TIMEOUT
        while not (output.ended or self._stopping.is_set()):
            if any(map(self._publish, output.read())):
                timeout, deadline = TIMEOUT, time.monotonic() + TIMEOUT
            elif time.monotonic() > deadline:
                return self._command.explain(output.words, f"no picture came from the camera for {timeout:g} s")
        return self._command.explain(output.words, "the camera's program has ended")

    def _publish(self, jpeg: bytes) -> bool:
        """Make this the newest picture; return whether it is one."""
        try:
            self._set(newest=self._decode(jpeg), count=self.count + 1, error=None)
        except JetbotError as error:
            self.complain(error)
            return False
        return True

    def _set(self, **attributes: Any) -> None:
        with self._changed:
            vars(self).update(attributes)
            self._changed.notify_all()


class Output:
    """What a child writes.

    words: what it has printed to stderr since its last picture; ended: whether it has closed its stdout, and prints no
    more.
    """

    def __init__(self, process: "subprocess.Popen[bytes]"):
        self._open: List[Any] = [process.stdout, process.stderr]
        self._stdout, self._stderr = self._open
        self._buffer, self.words, self.ended = bytearray(), b"", False

    def read(self) -> Deque[bytes]:
        """Wait for more, POLL_INTERVAL at most; return the newest JPEG since the last call, if there is one."""
        newest: Deque[bytes] = deque(maxlen=1)
        ready = select.select(self._open, [], [], POLL_INTERVAL)[0]  # in this order: last words come last
        for pipe in ready:
            data = os.read(pipe.fileno(), CHUNK)
            if not data:
                self._open.remove(pipe)
            elif pipe is self._stderr:
                self.words = (self.words + data)[-LAST_WORDS:]
            else:
                self._buffer += data
                newest.extend(iter(lambda: take(self._buffer), None))
                self.words = b"" if newest else self.words
        self.ended = not ready and self._stdout not in self._open
        return newest


@contextlib.contextmanager
def child(line: str) -> Iterator["subprocess.Popen[bytes]"]:
    """Run a shell command in a group of its own, which ends with the context: interrupted first, then killed.

    So does what it has started in other groups. The group also ends, within END_TIMEOUT, if this process does, be it
    killed.
    """
    mark = f"JETBOT_CAMERA={secrets.token_hex(8)}"
    with subprocess.Popen(WATCH, 0, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                          start_new_session=True) as watcher, \
            subprocess.Popen(["env", mark, "sh", "-c", line], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                             stderr=subprocess.PIPE, start_new_session=True) as process:
        try:
            watcher.stdin.write(b"%d\n" % process.pid)  # type: ignore[union-attr]  # a PIPE
            yield process
        finally:
            process.stdout.close()  # type: ignore[union-attr]  # a PIPE, in which it may wait for room
            send(process, signal.SIGINT)
            wait_until(lambda: os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT | os.WNOHANG), END_TIMEOUT)
            send(process, signal.SIGKILL)  # all of its group
            for pid in marked(mark):
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
            watcher.kill()


def marked(mark: str) -> Iterator[int]:
    """Yield the ids of the processes of this user that have this in their environment: proc(5)."""
    for file in Path("/proc").glob("[0-9]*/environ"):
        with contextlib.suppress(OSError):
            if mark.encode() in file.read_bytes().split(b"\0"):
                yield int(file.parent.name)


def send(process: "subprocess.Popen[bytes]", signum: int) -> None:
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signum)
