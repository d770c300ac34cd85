"""The files of a fake bus. Any program may have written them: reading one never waits, and not every file is a chip."""

import errno
import os
import stat
from pathlib import Path
from typing import Optional, Tuple, Union

from ..errors import BusError
from . import power_on_command

MAX_SIZE = 32  # bytes read of a file that holds a number


def open_file(file: Union[str, Path], flags: int) -> int:
    """Return a descriptor of the file; a pipe does not block. Raise OSError."""
    return os.open(file, flags | os.O_NONBLOCK)


def read_text(file: Union[str, Path]) -> Optional[str]:
    """Return the first ``MAX_SIZE`` bytes of a file as text: "" if it is not a regular file, None if there is none."""
    try:
        descriptor = open_file(file, os.O_RDONLY)
    except FileNotFoundError:
        return None
    try:
        regular = stat.S_ISREG(os.fstat(descriptor).st_mode)
        return os.read(descriptor, MAX_SIZE).decode("ascii", "replace") if regular else ""
    finally:
        os.close(descriptor)


def read_chip(file: Union[str, Path], size: int) -> Tuple[bytes, float]:
    """Return the registers in a chip's file, and the time of the last write to it. Raise as ``check_chip`` does."""
    descriptor = open_file(file, os.O_RDONLY)
    try:
        written = check_chip(descriptor, file, size).st_mtime
        return os.pread(descriptor, size, 0), written
    finally:
        os.close(descriptor)


def check_chip(descriptor: int, file: Union[str, Path], size: int) -> os.stat_result:
    """Return the status of a chip's open file of ``size`` bytes.

    Raise FileNotFoundError if it has been removed or replaced meanwhile, BusError if it holds no chip.
    """
    status = os.fstat(descriptor)
    if not status.st_nlink:
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(file))
    if not stat.S_ISREG(status.st_mode) or status.st_size != size:
        raise BusError(f"{file} is not a chip, which is a file of {size} bytes",
                       f"Make a new one: {power_on_command(Path(file).parent)}", errno.EINVAL)
    return status
