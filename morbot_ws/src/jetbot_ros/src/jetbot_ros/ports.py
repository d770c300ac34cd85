"""Which TCP ports of this computer are in use, and by which processes."""

import contextlib
import errno
import socket
from pathlib import Path
from typing import List, Set

from jetbot.host import processes_with

LISTEN = "0A"  # a state in /proc/net/tcp, whose columns are: number, local address, remote one, state ... 9: inode


def is_free(port: int) -> bool:
    """Return whether no process listens on this TCP port, at whatever address of this computer."""
    for family, address in ((socket.AF_INET, "0.0.0.0"), (socket.AF_INET6, "::")):
        try:
            with socket.socket(family, socket.SOCK_STREAM) as probe:
                probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)  # connections that have just ended
                if family == socket.AF_INET6:
                    probe.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_V6ONLY, 1)
                probe.bind((address, port))
        except OSError as error:  # any other: this computer has no such addresses
            if error.errno == errno.EADDRINUSE:
                return False
    return True


def processes_on(port: int, proc: Path = Path("/proc")) -> List[int]:
    """Return the ids of the processes that listen on a TCP port, as far as this user may see."""
    sockets = listening_sockets(port, proc)
    return processes_with(sockets, proc) if sockets else []


def listening_sockets(port: int, proc: Path) -> Set[str]:
    """Return the sockets that listen on a TCP port, as /proc/PID/fd shows them."""
    rows = []
    for table in ("tcp", "tcp6"):
        with contextlib.suppress(OSError):
            rows += (proc / "net" / table).read_text().splitlines()[1:]
    return {f"socket:[{row[9]}]" for row in map(str.split, rows)
            if row[3] == LISTEN and int(row[1].rpartition(":")[2], 16) == port}
