"""Calls of ROS's XML-RPC that give up on a program that does not answer."""

from http.client import HTTPException
from xmlrpc.client import Error, ServerProxy, Transport

NO_ANSWER = (OSError, HTTPException, Error)  # raised by a call to a program that hangs or is gone


class TimedTransport(Transport):
    """Gives up after ``timeout`` seconds without an answer."""

    def __init__(self, timeout: float):
        super().__init__()
        self._timeout = timeout

    def make_connection(self, host):
        connection = super().make_connection(host)
        connection.timeout = self._timeout
        return connection


def proxy(address: str, timeout: float) -> ServerProxy:
    """Return the program at this address; each of its calls may take ``timeout`` seconds, and raises NO_ANSWER."""
    return ServerProxy(address, TimedTransport(timeout))
