"""The folder of a class, which one cockpit has at a time: JSON in files that are replaced in one step."""

import contextlib
import errno
import json
import os
import secrets
import shutil
from pathlib import Path
from typing import Any, List, Optional

from jetbot import InvalidValue, files
from jetbot.text import printable

from ..notices import Notice, say
from .place import OWNER_ONLY
from .program import is_id

MAX_FILE = 2 << 20   # bytes of a file that is read


class Busy(Exception):
    """A cockpit has this class."""


class ClassFolder:
    """FOLDER/NAME, locked until it is closed, or this process ends. Raise InvalidValue if it cannot be used.

    problems: sentences for the terminal, about what could not be read. problem: why nothing is kept, or None.
    """

    problem: Optional[Notice] = None

    def __init__(self, folder: str, name: str):
        self._path = path_of(folder, name)
        self.problems: List[str] = []
        try:
            self._make()
            self._lock = lock(self._path) if self._path.exists() else None
        except Busy:
            raise InvalidValue(f"another cockpit has the class {name} open",
                               "End that one, or give this class another name.") from None
        except OSError as error:
            raise unusable(self._path, error) from None
        for unfinished in self._path.glob(".*.new"):  # of a cockpit that was killed
            with contextlib.suppress(OSError):
                unfinished.unlink()

    def _make(self):
        try:
            self._path.parent.mkdir(OWNER_ONLY, parents=True, exist_ok=True)
            self._path.mkdir(OWNER_ONLY, exist_ok=True)
            self._path.chmod(OWNER_ONLY)
        except OSError as error:
            if error.errno != errno.EROFS:
                raise
            self.problem = say("class_read_only", folder=self._path)
            self.problems.append(str(self.problem))

    def identify(self) -> Optional[str]:
        """Return the id of this class, which one of the same name that was deleted had not; None if it cannot be kept.

        Raise InvalidValue.
        """
        content = self.read("class")
        if isinstance(content, dict) and is_id(content.get("id")):
            return content["id"]
        try:
            id = secrets.token_hex(8)
            self.write("class", {"id": id})
        except OSError:
            return None
        return None if self.problem else id

    def names(self, prefix: str) -> List[str]:
        """Return the names of the files that begin like this, without their endings."""
        return sorted(file.stem for file in self._path.glob(f"{prefix}*.json"))

    def read(self, name: str) -> Any:
        """Return what a file holds, or None if there is none; one that is damaged is put aside. Raise InvalidValue."""
        file = self._file(name)
        try:
            return json.loads(files.read(file, MAX_FILE)) if file.exists() else None
        except OSError as error:
            if error.errno not in (errno.EFBIG, errno.EINVAL):  # too large, or no regular file
                raise unusable(file, error) from None
        except (ValueError, RecursionError):
            pass
        self.set_aside(name)
        return None

    def set_aside(self, name: str) -> None:
        """Keep a damaged file under another name."""
        file = self._file(name)
        self.problems.append(f"{file} is damaged, and was renamed to {file.stem}.damaged")
        with contextlib.suppress(OSError):
            file.replace(file.with_suffix(".damaged"))

    def write(self, name: str, content: Any) -> None:
        """Replace a file; it is on the disk when this returns, unless nothing is kept. Raises OSError."""
        if self.problem:
            return
        files.replace(self._file(name), json.dumps(content, ensure_ascii=False).encode())
        self._sync()

    def remove(self, name: str) -> None:
        """Delete a file. Raises OSError."""
        if not self.problem:
            self._file(name).unlink()

    def close(self) -> None:
        """Let another cockpit have the class."""
        if self._lock is not None:
            os.close(self._lock)

    def _file(self, name):
        return self._path / f"{name}.json"

    def _sync(self):
        """Let the names of the files survive a power cut as well."""
        folder = os.open(self._path, os.O_RDONLY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)


class Nowhere(ClassFolder):
    """Stands for the folder of a class without a name: nothing is kept, and everything ends with the cockpit."""

    def __init__(self):
        self.problems = []

    def _do_nothing(self, *_):
        return ()

    names = read = write = remove = _do_nothing

    def identify(self) -> None:
        """Return None: a later cockpit may have what pages keep of this one."""


def unusable(path: Path, error: OSError) -> InvalidValue:
    """Return the error for a class that cannot be kept or read."""
    return InvalidValue(f"{printable(path)} cannot be used to keep a class: {error.strerror or error}",
                        "Choose another folder, as in classes:=~/classes, or leave out class.")


def path_of(folder: str, name: str) -> Path:
    """Return the folder of a class. folder: "~/..." or absolute."""
    return Path(folder).expanduser() / name


def lock(path: Path) -> int:
    """Lock a folder until this process ends; return its descriptor. Raise Busy, OSError."""
    import fcntl  # here: a hub, which locks no folder, also runs on Windows
    descriptor = os.open(path, os.O_RDONLY | os.O_DIRECTORY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if os.path.samestat(os.fstat(descriptor), os.stat(path)):  # not one that ``forget`` has just deleted
            return descriptor
    except OSError as error:
        os.close(descriptor)
        raise Busy from error
    os.close(descriptor)
    raise Busy


def forget(folder: str, name: str) -> Optional[int]:
    """Delete a class; return how many files that were, or None if there is no such class. Raise Busy, OSError."""
    path = path_of(folder, name)
    if not path.is_dir():
        return None
    descriptor = lock(path)
    try:
        count = sum(file.is_file() for file in path.rglob("*"))
        shutil.rmtree(path)
    finally:
        os.close(descriptor)
    return count
