"""Calls of ROS's XML-RPC to programs that may hang, be gone, or be no ROS program at all."""

import io
from http.client import HTTPException
from xml.parsers.expat import ExpatError
from xmlrpc.client import Error, ServerProxy, Transport

MAX_ANSWER = 1024 * 1024  # bytes
# Raised by a call to what hangs, is gone, or answers something else than ROS.
NO_ANSWER = (OSError, HTTPException, Error, ExpatError, ValueError, TypeError, LookupError)


class BoundedTransport(Transport):
    """Gives up on what sends nothing for ``timeout`` seconds, or more than ``MAX_ANSWER``."""

    accept_gzip_encoding = False

    def __init__(self, timeout: float):
        super().__init__()
        self._timeout = timeout

    def make_connection(self, host):
        connection = super().make_connection(host)
        connection.timeout = self._timeout
        return connection

    def parse_response(self, response):
        return super().parse_response(io.BytesIO(response.read(MAX_ANSWER)))


def proxy(address: str, timeout: float) -> ServerProxy:
    """Return the program at this address; a call of it raises NO_ANSWER after ``timeout`` seconds without an answer."""
    return ServerProxy(address, BoundedTransport(timeout))
