"""Small files that a person names: read without waiting, and replaced in one step. All raise OSError."""

import contextlib
import errno
import functools
import itertools
import os
import secrets
import shutil
import tempfile
from pathlib import Path
from typing import Iterable, Optional, Union

Name = Union[str, Path]

MAX_SIZE = 64 * 1024  # bytes


def read(file: Name, max_size: int = MAX_SIZE) -> bytes:
    """Return the content of a regular file of ``max_size`` bytes at most."""
    check_regular(file)
    with open(file, "rb") as stream:
        content = stream.read(max_size + 1)
    if len(content) > max_size:
        raise OSError(errno.EFBIG, f"larger than {max_size // 1024} kB", str(file))
    return content


def check_regular(file: Name) -> None:
    """Check that this is a regular file. It is not opened: a FIFO would wait, and a device may act."""
    os.stat(file)
    if not os.path.isfile(file):
        raise OSError(errno.EINVAL, "not a regular file", str(file))


def shipped(module: Name, package: str, folder: str) -> Path:
    """Return a folder of a catkin package, in the source or where it is installed. module: a module of the package."""
    root = Path(module).resolve().parents[2]  # the package; where it is installed, lib/python3
    installed = root.parents[1] / "share" / package / folder
    return installed if installed.is_dir() else root / folder


def check_writable(file: Name) -> None:
    """Check that ``replace`` can write the file."""
    target = Path(os.path.realpath(file))
    if target.exists():
        check_regular(target)
    try:
        tempfile.TemporaryFile(dir=target.parent).close()
    except OSError as error:
        error.filename = str(target)
        raise


def replace(file: Name, content: bytes) -> None:
    """Write a file in one step: a program that is killed leaves the old content or all of the new one.

    A link stays, and the file that it leads to is replaced.
    """
    target = Path(os.path.realpath(file))
    new = target.with_name(f".{secrets.token_hex(8)}.new")
    mode = 0o600 if target.exists() else 0o666  # nobody reads it before it has the permissions of the old file
    try:
        with open(new, "xb", opener=functools.partial(os.open, mode=mode)) as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        if target.exists():
            shutil.copymode(target, new)
        os.replace(new, target)
    except OSError as error:
        error.filename = str(target)  # the name that the user knows
        raise
    finally:
        with contextlib.suppress(OSError):
            new.unlink()


def replace_secret(file: Name, content: bytes) -> None:
    """Do the same with a file that only its user reads, from the moment in which it is there."""
    if not os.path.exists(file):
        os.close(os.open(file, os.O_CREAT | os.O_WRONLY, 0o600))
    os.chmod(file, 0o600)
    replace(file, content)


def keep(file: Name) -> Optional[Path]:
    """Copy a file to the first free name of FILE.1, FILE.2, ...; return that, or None if there is no file."""
    target = os.path.realpath(file)
    if not os.path.exists(target):
        return None
    copy = Path(first_unused(f"{target}.{number}" for number in itertools.count(1)))
    copy.write_bytes(read(target))
    return copy


def first_unused(names: Iterable[str]) -> str:
    """Return the first of these names that no file has."""
    return next(name for name in names if not os.path.lexists(name))
