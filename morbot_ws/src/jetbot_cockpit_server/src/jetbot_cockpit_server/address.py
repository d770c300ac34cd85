"""By which names and addresses other computers reach this one."""

import contextlib
import socket
from typing import List

import rosgraph.network

from jetbot.host import is_loopback

ROUTE_PROBES = ((socket.AF_INET, "192.0.2.1"), (socket.AF_INET6, "2001:db8::1"))  # RFC 5737 and 3849: nobody's


def lan_addresses() -> List[str]:
    """Return this computer's addresses that are not loopback ones, the one that reaches other networks first."""
    found = [address for address in rosgraph.network.get_local_addresses() if not is_loopback(address)]
    return list(dict.fromkeys([*_routed_addresses(), *found]))


def host_names() -> List[str]:
    """Return this computer's name, and its name in the local network where multicast DNS is at hand."""
    name = socket.gethostname().lower()
    return [name] if "." in name else [name, f"{name}.local"]


def _routed_addresses() -> List[str]:
    """Return the addresses from which this computer sends to other networks; nothing is sent."""
    addresses = []
    for family, probe_address in ROUTE_PROBES:
        with contextlib.suppress(OSError), socket.socket(family, socket.SOCK_DGRAM) as probe:
            probe.connect((probe_address, 9))
            addresses.append(probe.getsockname()[0])
    return addresses
