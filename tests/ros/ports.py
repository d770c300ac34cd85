"""Ports for masters."""

import socket


def free_port():
    """A port of this computer that nobody uses."""
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]
