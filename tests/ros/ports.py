"""Free ports for ROS masters."""

import socket


def free_port() -> int:
    """Return a TCP port of this computer that no program uses."""
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]
