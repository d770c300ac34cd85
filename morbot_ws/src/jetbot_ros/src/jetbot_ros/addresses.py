"""Where the ROS master is, and whether a process listens at an address. Quick to import."""

import os
import socket
import sys
from urllib.parse import urlsplit

CONNECT_TIMEOUT = 5.0  # s


def master_uri() -> str:
    """Return the master's address."""
    typed = [argument.partition(":=")[2] for argument in sys.argv if argument.startswith("__master:=")]
    return (typed or [os.environ.get("ROS_MASTER_URI")])[0] or "http://localhost:11311"


def is_reachable(uri: str) -> bool:
    """Return whether a process, which may be frozen, listens at this address."""
    try:
        address = urlsplit(uri)
        socket.create_connection((address.hostname, address.port), CONNECT_TIMEOUT).close()
    except (OSError, ValueError):
        return False
    return True
