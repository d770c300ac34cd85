"""The processes of a browser, and the signals that they get."""

import os
import signal
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Iterator, List

from jetbot.wait import wait_until
from processes import children

END_TIMEOUT = 20.0  # s


class BrowserProcesses:
    """A browser. _parent: the id of the driver that has started it."""

    _parent: int

    @property
    def processes(self) -> List[int]:
        """Return the ids of the browser's processes."""
        return descendants(self._parent)

    @property
    def runs(self) -> bool:
        """Return whether the browser was not killed."""
        return any(map(is_running, self.processes))

    def signal(self, signum: int) -> None:
        """Send a signal to all processes of the browser."""
        send_signal(self.processes, signum)

    @contextmanager
    def all_killed(self) -> Iterator[None]:
        """Kill what still runs of the browser after this context, and wait for its end."""
        processes = self.processes
        yield
        send_signal(processes, signal.SIGKILL)
        assert wait_until(lambda: not any(map(is_running, processes)), END_TIMEOUT), "the browser does not end"


def send_signal(processes: List[int], signum: int) -> None:
    """Send a signal to the processes that still run."""
    for pid in processes:
        with suppress(ProcessLookupError):
            os.kill(pid, signum)


def descendants(pid: int) -> List[int]:
    """Return the ids of the processes that a process has started, and of those that these have."""
    return [each for child in children(pid) for each in [child, *descendants(child)]]


def is_running(pid: int) -> bool:
    """Return whether a process runs; a zombie does not."""
    with suppress(OSError):
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    return False
