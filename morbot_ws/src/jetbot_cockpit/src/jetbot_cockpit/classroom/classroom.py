"""A class, as the cockpit uses it: only one thread writes, so that a slow disk holds up no robot."""

import threading
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, Callable, Dict, List, Optional

from jetbot.text import printable

from ..notices import say
from .folder import ClassFolder, Nowhere
from .programs import Programs

MAX_WAITING = 50  # changes that a slow disk holds up


class DiskBusy(Exception):
    """Too many changes wait for the disk."""


class Classroom:
    """programs: those of all robots; problem: why the class is not kept now, or None; id: see ClassFolder.identify.

    folder: a ClassFolder, or Nowhere.
    """

    def __init__(self, folder=None):
        self._folder = folder or Nowhere()
        self.id, self.programs, self.problem = self._folder.identify(), Programs(self._folder), self._folder.problem
        self._thread, self._room = ThreadPoolExecutor(1), threading.Semaphore(MAX_WAITING)
        self._waiting: Dict[str, Any] = {}      # what is not kept yet, by its name
        self._attempt: Optional[Future] = None  # to keep it; the last one

    def read(self, name: str, kind: type) -> Any:
        """Return what is kept by this name, or an empty one; another kind is put aside. Raise InvalidValue."""
        content = self._folder.read(name)
        if isinstance(content, kind):
            return content
        if content:
            self._folder.set_aside(name)
        return kind()

    def keep(self, name: str, content: Any) -> None:
        """Keep this soon; if it cannot be kept, try again until it is, or there is a newer one."""
        self._waiting[name] = content
        self._attempt = self._thread.submit(self._write)

    def retry(self) -> None:
        """Try again to keep what is not kept yet; call it now and then."""
        if self._waiting and self._attempt.done():
            self._attempt = self._thread.submit(self._write)

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
        return list(map(printable, problems))

    def _write(self):
        """Write all that waits. This runs in the thread."""
        problem = self._folder.problem
        for name in list(self._waiting):
            content = self._waiting.pop(name)
            try:
                self._folder.write(name, content)
            except OSError as error:
                self._waiting.setdefault(name, content)  # unless there is a newer one by now
                problem = say("class_not_kept", problem=error.strerror or error)
        if problem != self.problem:
            self._folder.problems.append(str(problem or say("class_kept_again")))
        self.problem = problem


def open_classroom(folder: str, name: str) -> Classroom:
    """Return the class of this name, or one that ends with the cockpit if that is "". Raise InvalidValue."""
    return Classroom(ClassFolder(folder, name) if name else Nowhere())
