"""The sockets on which the page is served, and which program has their port."""

import errno
import os
import socket
from typing import List

from tornado.netutil import bind_sockets

from jetbot import InvalidValue
from jetbot.host import program_name
from jetbot.text import enumeration
from jetbot_ros.launcher import LAUNCHED
from jetbot_ros.ports import COCKPIT_PORT, processes_on

ADDRESSES = {False: ("127.0.0.1", "::1"), True: ("0.0.0.0", "::")}
NO_IPV6 = (errno.EADDRNOTAVAIL, errno.EAFNOSUPPORT)
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
    """Return the error for a port that cannot be used."""
    reason, other = os.strerror(error.errno), port + 1
    if error.errno == errno.EADDRINUSE:
        holders = [f"{program_name(pid) or 'a program'} (process {pid})" for pid in processes_on(port)]
        reason = f"{enumeration(holders) if holders else 'another program'} uses it"
    elif error.errno == errno.EACCES:  # below 1024
        other = COCKPIT_PORT
    return InvalidValue(f"the cockpit cannot use port {port}: {reason}", f"Choose another port: {advice(other)}")


def advice(port: int) -> str:
    """Return how to choose a port, where this program was started."""
    if LAUNCHED:
        return f"cockpit_port:={port} (of cockpit.launch: port:={port})"
    return f"_port:={port}"
