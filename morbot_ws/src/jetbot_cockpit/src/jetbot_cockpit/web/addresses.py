"""At which addresses the page is served, and by which names and addresses other computers reach it."""

import contextlib
import errno
import os
import socket
from typing import List

from tornado.netutil import bind_sockets

from jetbot import InvalidValue
from jetbot.host import is_loopback, program_name
from jetbot.text import enumeration
from jetbot_ros.contract import COCKPIT_PORT
from jetbot_ros.launcher import LAUNCHED
from jetbot_ros.ports import processes_on

ADDRESSES = {False: ("127.0.0.1", "::1"), True: ("0.0.0.0", "::")}
NO_IPV6 = (errno.EADDRNOTAVAIL, errno.EAFNOSUPPORT, socket.EAI_ADDRFAMILY)
ROUTE_PROBES = ((socket.AF_INET, "192.0.2.1"), (socket.AF_INET6, "2001:db8::1"))  # RFC 5737 and 3849: nobody's


def listen(port: int, lan: bool, option: str = "") -> List[socket.socket]:
    """Return sockets that listen on a port, IPv4's first: of the loopback alone, or with ``lan`` of all interfaces.

    port: 0 for any free one; option: how another one is typed, where that is not ROS's way. Raise InvalidValue if it
    cannot be used.
    """
    ipv4, ipv6 = ADDRESSES[lan]
    sockets: List[socket.socket] = []
    try:
        sockets += bind_sockets(port, ipv4, socket.AF_INET)
        sockets += bind_sockets(sockets[0].getsockname()[1], ipv6, socket.AF_INET6)
    except OSError as error:  # socket.gaierror is one too
        if not sockets or error.errno not in NO_IPV6:
            raise refusal(port, error, option) from None
    return sockets


def refusal(port: int, error: OSError, option: str = "") -> InvalidValue:
    """Return the error for a port that cannot be used."""
    reason, other = os.strerror(error.errno), port + 1
    if error.errno == errno.EADDRINUSE:
        holders = [f"{program_name(pid) or 'a program'} (process {pid})" for pid in processes_on(port)]
        reason = f"{enumeration(holders) if holders else 'another program'} uses it"
    elif error.errno == errno.EACCES:  # below 1024
        other = COCKPIT_PORT
    in_ros = f"cockpit_port:={other} (of cockpit.launch: port:={other})" if LAUNCHED else f"_port:={other}"
    typed = f"{option} {other}" if option else in_ros
    return InvalidValue(f"the cockpit cannot use port {port}: {reason}", f"Choose another port: {typed}")


def lan_addresses() -> List[str]:
    """Return this computer's addresses that are not loopback ones, the one that reaches other networks first."""
    found = [address for address in _interface_addresses() if not is_loopback(address)]
    return list(dict.fromkeys([*_routed_addresses(), *found]))


def host_names() -> List[str]:
    """Return this computer's name, and its name in the local network where multicast DNS is at hand."""
    name = socket.gethostname().lower()
    return [name] if "." in name else [name, f"{name}.local"]


def _interface_addresses() -> List[str]:
    """Return the addresses of all interfaces; without ROS, those that this computer's name has."""
    try:
        import rosgraph.network
    except ImportError:
        with contextlib.suppress(OSError):
            return [info[4][0] for info in socket.getaddrinfo(socket.gethostname(), None)]
        return []
    rosgraph.network._local_addrs = None  # its cache: a network may have come up
    return list(rosgraph.network.get_local_addresses())


def _routed_addresses() -> List[str]:
    """Return the addresses from which this computer sends to other networks; nothing is sent."""
    addresses = []
    for family, probe_address in ROUTE_PROBES:
        with contextlib.suppress(OSError), socket.socket(family, socket.SOCK_DGRAM) as probe:
            probe.connect((probe_address, 9))
            addresses.append(probe.getsockname()[0])
    return addresses
