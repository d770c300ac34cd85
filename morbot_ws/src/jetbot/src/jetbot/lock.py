"""One program that drives a board: a lock that ends with its process, however that ends."""

import errno
import os
import socket
import stat
import struct
from pathlib import Path
from typing import Optional

from . import fake
from .errors import JetbotError
from .fake.bus import power_on
from .host import program_name

NAME_SIZE = 100  # bytes; a socket's name may have 108
REFUSED = 1000   # programs that may be refused until a name of the holder is no longer found
CREDENTIALS = struct.Struct("3i")  # struct ucred of unix(7): process, user, group


def lock_board(place: str, address: Optional[int]) -> socket.socket:
    """Return a lock on the board at this place (``connection.locate``) and I2C address; it is held until it is closed.

    Raises JetbotError if another program holds it. The lock is the name of an abstract socket, unix(7): it reaches all
    users, and the containers that share this network namespace (``network_mode: host``).
    """
    name = f"\0jetbot {identity(place, address)} {address}".encode()[:NAME_SIZE]
    lock = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        lock.bind(name)
        lock.listen(REFUSED)
    except OSError as error:
        lock.close()
        if error.errno != errno.EADDRINUSE:
            raise
        board = f"0x{address:02x} on {place}" if address else place
        raise JetbotError(f"another program{holder(name)} already drives {board}", "End that first.") from None
    return lock


def identity(place: str, address: Optional[int]) -> str:
    """Return what names the board's bus or port, whatever path leads to it. A fake one is made, with the board."""
    folder = fake.folder_of(place)
    try:
        if folder and not Path(folder).exists():
            power_on(folder, address)
        status = os.stat(folder or place)
    except OSError:  # whoever opens it explains
        return place
    return f"device {status.st_rdev}" if stat.S_ISCHR(status.st_mode) else f"{status.st_dev}:{status.st_ino}"


def holder(name: bytes) -> str:
    """Return " (PROGRAM, process N)" for the process that holds the lock, "" if that cannot be seen."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as probe:
        probe.setblocking(False)
        try:
            probe.connect(name)
        except OSError:
            return ""
        pid = CREDENTIALS.unpack(probe.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, CREDENTIALS.size))[0]
    if not pid:  # in another container
        return ""
    program = program_name(pid)
    return f" ({program}, process {pid})" if program else f" (process {pid})"
