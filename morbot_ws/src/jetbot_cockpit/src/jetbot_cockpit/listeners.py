"""The sockets on which the page is served, and which program has their port."""

import contextlib
import errno
import os
import re
import socket
from pathlib import Path
from typing import List, Set

from tornado.netutil import bind_sockets

from jetbot import InvalidValue
from jetbot.host import program_name
from jetbot_ros.launcher import LAUNCHED

ADDRESSES = {False: ("127.0.0.1", "::1"), True: ("0.0.0.0", "::")}
NO_IPV6 = (errno.EADDRNOTAVAIL, errno.EAFNOSUPPORT)
LISTENS = "0A"       # a state in /proc/net/tcp
FREE_PORT_TRIES = 10


def listen(port: int, lan: bool) -> List[socket.socket]:
    """Return sockets that listen on a port, IPv4's first: of the loopback alone, or with ``lan`` of all interfaces.

    port: 0 for any free one. Raise InvalidValue if it cannot be used.
    """
    tries_left = FREE_PORT_TRIES if port == 0 else 1
    while True:
        try:
            return _listen(port, *ADDRESSES[lan])
        except OSError as error:  # of port 0, if IPv6 does not have the port that IPv4 has
            tries_left -= 1
            if not tries_left:
                raise refusal(port, error) from None


def _listen(port: int, ipv4: str, ipv6: str) -> List[socket.socket]:
    sockets = bind_sockets(port, ipv4, socket.AF_INET)
    try:
        sockets += bind_sockets(sockets[0].getsockname()[1], ipv6, socket.AF_INET6)
    except OSError as error:  # socket.gaierror is one too
        if error.errno not in (*NO_IPV6, socket.EAI_ADDRFAMILY):
            sockets[0].close()
            raise
    return sockets


def refusal(port: int, error: OSError) -> InvalidValue:
    """Return what the user is told of a port that cannot be used."""
    reason = os.strerror(error.errno)
    if error.errno == errno.EADDRINUSE:
        holder = holder_of(port)
        reason = f"{holder} has it" if holder else "another program has it"
    option = "port" if LAUNCHED else "_port"
    return InvalidValue(f"the cockpit cannot use port {port}: {reason}",
                        f"End that program, or choose another port: {option}:={port + 1 if port >= 1024 else 8080}")


def holder_of(port: int, proc: Path = Path("/proc")) -> str:
    """Return the name and the id of the program that listens on a TCP port; "" where /proc does not show it."""
    inodes = {f"socket:[{inode}]" for table in ("tcp", "tcp6") for inode in listening(proc / "net" / table, port)}
    for link in proc.glob("[0-9]*/fd/*"):
        with contextlib.suppress(OSError):  # it has just ended, or is another user's
            if os.readlink(link) in inodes:
                pid = int(link.parts[-3])
                return f"{program_name(pid, proc)} (process {pid})"
    return ""


def listening(table: Path, port: int) -> Set[str]:
    """Return the inodes of the sockets in a table of /proc/net that listen on a port."""
    with contextlib.suppress(OSError):
        rows = [line.split() for line in table.read_text().splitlines()[1:]]
        return {row[9] for row in rows if row[3] == LISTENS and re.search(f":{port:04X}$", row[1])}
    return set()
