"""Small files that a person names: read without waiting, and replaced in one step."""

import contextlib
import errno
import itertools
import os
import secrets
import shutil
import stat
from pathlib import Path
from typing import Iterator, Optional, Union

Name = Union[str, Path]

MAX_SIZE = 64 * 1024  # bytes


def read(file: Name, max_size: int = MAX_SIZE) -> bytes:
    """Return the content of a regular file; raise OSError for a larger one and for any other kind of file."""
    check_regular(file)
    descriptor = os.open(file, os.O_RDONLY | os.O_NONBLOCK)  # it may be a FIFO by now
    with open(descriptor, "rb") as stream:
        content = stream.read(max_size + 1) or b""
    if len(content) > max_size:
        raise OSError(errno.EFBIG, f"larger than {max_size // 1024} kB", str(file))
    return content


def check_regular(file: Name) -> None:
    """Raise OSError unless this is a regular file. It is not opened: a FIFO would wait, and a device may act."""
    if not stat.S_ISREG(os.stat(file).st_mode):
        raise OSError(errno.EINVAL, "not a regular file", str(file))


def shipped(module: Name, package: str, folder: str) -> Path:
    """Return a folder of a catkin package, in the source or where it is installed. module: a module of the package."""
    root = Path(module).resolve().parents[2]  # the package; where it is installed, lib/python3
    installed = root.parents[1] / "share" / package / folder
    return installed if installed.is_dir() else root / folder


def is_missing(file: Name) -> bool:
    """Return whether there is certainly no such file: False where a link leads nowhere or a folder is closed."""
    try:
        os.stat(file)
    except FileNotFoundError:
        places = (Path(file), *Path(file).parents)
        return not any(os.path.islink(place) and not os.path.exists(place) for place in places)
    except OSError:
        pass
    return False


def check_writable(file: Name) -> None:
    """Raise OSError if ``replace`` could not write the file."""
    target = _target(file)
    with contextlib.suppress(FileNotFoundError):
        check_regular(target)
    with _new_file(target, b""):
        pass


def replace(file: Name, content: bytes) -> None:
    """Write a file in one step: a program that is killed leaves the old content or all of the new one.

    A link stays, and the file that it leads to is replaced. Raises OSError.
    """
    target = _target(file)
    with _new_file(target, content) as new:
        with contextlib.suppress(FileNotFoundError):
            shutil.copymode(target, new)
        os.replace(new, target)
    with contextlib.suppress(OSError):  # some folders can be written, but not opened
        _sync_folder(target.parent)


def keep(file: Name) -> Optional[Path]:
    """Copy a file to the first free name of FILE.1, FILE.2, ...; return that, or None if there is no file."""
    target = _target(file)
    try:
        content = read(target)
    except FileNotFoundError:
        return None
    for copy in (Path(f"{target}.{number}") for number in itertools.count(1)):
        with contextlib.suppress(FileExistsError):
            _write_new(copy, content)
            break
    return copy


def _target(file: Name) -> Path:
    """Return the file that a link leads to."""
    target = Path(os.path.realpath(file))
    if target.is_symlink():
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP), str(file))
    return target


@contextlib.contextmanager
def _new_file(target: Path, content: bytes) -> Iterator[Path]:
    """Write a file of a unique name in the folder of the target; remove it at the end unless it was renamed."""
    new = target.with_name(f".{secrets.token_hex(8)}.new")
    try:
        _write_new(new, content)
        yield new
    except OSError as error:
        error.filename = str(target)  # the name that the user knows
        raise
    finally:
        with contextlib.suppress(OSError):
            new.unlink()


def _write_new(file: Path, content: bytes) -> None:
    """Write a file to the disk; raise FileExistsError if there is one of this name."""
    with file.open("xb") as stream:
        stream.write(content)
        stream.flush()
        os.fsync(stream.fileno())


def _sync_folder(folder: Path) -> None:
    """Write the names in a folder to the disk."""
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
