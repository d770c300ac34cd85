"""The pictures that people collect to train with: FOLDER/ROBOT/LABEL/NNNN.jpg on this computer."""

import errno
import os
import queue
import threading
from pathlib import Path
from typing import Callable, Dict, Optional, Union

from jetbot import files

from ..notices import Notice, say

LABELS = "free", "blocked"
MAX_PICTURES = 1000  # of a label
MAX_WAITING = 10     # actions that a slow disk holds up
FOLDERS = {"": "robot", "robot": "robot."}  # of robots whose names would collide; no name has a dot


class Collection:
    """No method blocks: a thread of its own writes. folder: "~/..." or absolute; False: nothing is kept."""

    def __init__(self, folder: Union[str, bool]):
        self._folder = folder and Path(folder).expanduser()
        self._states: Dict[str, dict] = {}
        self._actions: queue.Queue = queue.Queue(MAX_WAITING)
        if folder:
            threading.Thread(target=self._run, daemon=True).start()

    def state(self, robot: str) -> Optional[dict]:
        """Return how many pictures of each label there are, and what went wrong, or None; None if none are kept."""
        if robot not in self._states:
            self._do(robot, lambda: None)  # it only counts
        return self._states.get(robot)

    def save(self, robot: str, label: str, jpeg: bytes) -> Optional[Notice]:
        """Keep a picture; return why not, or None."""
        return self._do(robot, lambda: self._write(robot, label, jpeg))

    def delete(self, robot: str) -> Optional[Notice]:
        """Delete all pictures of the robot, and no other file; return why not, or None."""
        return self._do(robot, lambda: self._unlink(robot))

    def _do(self, robot: str, action: Callable[[], Optional[Notice]]) -> Optional[Notice]:
        if not self._folder:
            return say("no_pictures_kept")
        try:
            self._actions.put_nowait((robot, action))
        except queue.Full:
            return say("pictures_busy")
        self._states.setdefault(robot, {**dict.fromkeys(LABELS, 0), "problem": None})
        return None

    def _run(self):
        while True:
            robot, action = self._actions.get()
            try:
                problem = action()
            except OSError as error:
                problem = say("picture_not_kept", problem=error.strerror, file=error.filename)
            counts = {label: len(self._files(robot, label)) for label in LABELS}
            self._states[robot] = {**counts, "problem": problem and problem.fields()}

    def _write(self, robot, label, jpeg):
        folder = self._check(robot, label)
        folder.mkdir(parents=True, exist_ok=True)
        names = (folder / f"{number:04}.jpg" for number in range(1, MAX_PICTURES + 1))
        unused = next((name for name in names if not os.path.lexists(name)), None)
        if unused is None:
            return say(f"{label}_full", count=MAX_PICTURES)
        files.replace(unused, jpeg)
        return None

    def _unlink(self, robot):
        for label in LABELS:
            self._check(robot, label)
            for file in self._files(robot, label):
                file.unlink()
        return

    def _files(self, robot, label):
        return list(self._folder_of(robot, label).glob("[0-9][0-9][0-9][0-9].jpg"))

    def _check(self, robot, label):
        """Return the folder; raise OSError where a link leads elsewhere."""
        folder = self._folder_of(robot, label)
        for place in folder.parent, folder:
            if place.is_symlink():
                raise OSError(errno.ELOOP, "This folder is a link", str(place))
        return folder

    def _folder_of(self, robot, label):
        name = robot.strip("/")
        return self._folder / FOLDERS.get(name, name.replace("/", ".")) / label
