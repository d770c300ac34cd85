"""A class, as the cockpit uses it: only one thread writes, so that a slow disk holds up no robot."""

import threading
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any, Callable, List

from .folder import ClassFolder, Nowhere, unusable
from .programs import Programs

MAX_WAITING = 50  # changes that a slow disk holds up


class DiskBusy(Exception):
    """Too many changes wait for the disk."""


class Classroom:
    """programs: those of all robots. folder: a ClassFolder, or Nowhere."""

    def __init__(self, folder=None):
        self._folder = folder or Nowhere()
        self.programs = Programs(self._folder)
        self._thread, self._room = ThreadPoolExecutor(1), threading.Semaphore(MAX_WAITING)

    def read(self, name: str, kind: type) -> Any:
        """Return what is kept by this name, or an empty one; another kind is put aside. Raise InvalidValue."""
        content = self._folder.read(name)
        if isinstance(content, kind):
            return content
        if content:
            self._folder.set_aside(name)
        return kind()

    def write(self, name: str, content: Any) -> None:
        """Keep this; it is on the disk when this returns. Raise InvalidValue."""
        try:
            self._folder.write(name, content)
        except OSError as error:
            raise unusable(Path(error.filename or name), error) from None

    def keep(self, name: str, content: Any) -> None:
        """Keep this soon; what cannot be kept is reported, and the next one holds all of it."""
        self._thread.submit(self._folder.write, name, content).add_done_callback(self._report)

    def do(self, action: Callable, *arguments: Any) -> Future:
        """Let the thread change the programs. Raise DiskBusy."""
        if not self._room.acquire(blocking=False):
            raise DiskBusy
        future = self._thread.submit(action, *arguments)
        future.add_done_callback(lambda _: self._room.release())
        return future

    def take_problems(self) -> List[str]:
        """Return what the terminal should report since the last call."""
        problems, self._folder.problems = self._folder.problems, []
        return problems

    def _report(self, future):
        if future.exception():
            self._folder.problems.append(f"The class cannot be kept: {future.exception()}")


def open_classroom(folder: str, name: str) -> Classroom:
    """Return the class of this name, or one that ends with the cockpit if that is "". Raise InvalidValue."""
    return Classroom(ClassFolder(folder, name) if name else Nowhere())
