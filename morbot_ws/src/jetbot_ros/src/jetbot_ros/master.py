"""All questions to the ROS master and to nodes, each with a time limit: rospy would wait forever. Quick to import."""

import errno
import io
import os
import socket
import sys
from http.client import HTTPException
from typing import Any, Dict, List, Optional, Type
from urllib.parse import urlsplit
from xml.parsers.expat import ExpatError
from xmlrpc.client import Error, ServerProxy, Transport

from .contract import COCKPIT, CONTROLLER

TIMEOUT = 2.0             # s for an answer
MAX_ANSWER = 1024 * 1024  # bytes
CALLER = "/morbot"
NOT_ANSWERING = "The ROS master at {} does not answer. Is it frozen (Ctrl-Z)? Continue it with fg, or restart it."
ALIVE, FROZEN = "is already running", "is already running, but frozen (Ctrl-Z?)"
# Raised by a question to what hangs (socket.timeout), is gone, refuses (LookupError), or is no ROS program at all.
NO_ANSWER = (OSError, HTTPException, Error, ExpatError, ValueError, TypeError, LookupError)
SECOND_ONE = {  # by the last part of a node's name: what to do instead of starting a second one
    COCKPIT: "Its page has all robots of this ROS master.",
    CONTROLLER: "A second robot is launched with robot_name:=NAME."}


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

    def request(self, *arguments, **options):
        try:
            return super().request(*arguments, **options)
        except socket.timeout:
            raise socket.timeout(errno.ETIMEDOUT, "no answer") from None  # both: rospy unpacks a number and a text

    def parse_response(self, response):
        return super().parse_response(io.BytesIO(response.read(MAX_ANSWER)))


class CachingTransport(BoundedTransport):
    """Parses an answer that is the same as the one before only once: that of a class of robots takes 6 ms."""

    def __init__(self, timeout: float):
        super().__init__(timeout)
        self._body, self._answer = None, None

    def parse_response(self, response):
        body = response.read(MAX_ANSWER)
        if body != self._body:
            self._answer = super().parse_response(io.BytesIO(body))
            self._body = body
        return self._answer


def proxy(uri: str, timeout: float = TIMEOUT, transport: Type[BoundedTransport] = BoundedTransport) -> ServerProxy:
    """Return the master, node or roslaunch at this address; a call of it raises NO_ANSWER. For one thread."""
    return ServerProxy(uri, transport(timeout))


def master_uri() -> str:
    """Return the master's address."""
    typed = [argument.partition(":=")[2] for argument in sys.argv if argument.startswith("__master:=")]
    return (typed or [os.environ.get("ROS_MASTER_URI")])[0] or "http://localhost:11311"


def is_reachable(uri: str) -> bool:
    """Return whether a process, which may be frozen, listens at this address."""
    try:
        address = urlsplit(uri)
        socket.create_connection((address.hostname, address.port), TIMEOUT).close()
    except (OSError, ValueError):
        return False
    return True


def ask(server: ServerProxy, method: str, *arguments) -> Any:
    """Return the answer to a call of ROS's master or slave API; raise NO_ANSWER."""
    code, message, value = getattr(server, method)(CALLER, *arguments)
    if code != 1:
        raise LookupError(message)
    return value


def ask_master(method: str, *arguments) -> Any:
    """Return the master's answer; raise NO_ANSWER."""
    return ask(proxy(master_uri()), method, *arguments)


def system_state() -> List[Dict[str, List[str]]]:
    """Return the nodes of each topic that is published, of each that is subscribed to, of each service.

    Those that have died are still among them. Raise NO_ANSWER.
    """
    return [dict(part) for part in ask_master("getSystemState")]


def address_of(node: str) -> Optional[str]:
    """Return where a node is, or was, None if the master does not know it; raise NO_ANSWER."""
    try:
        return ask_master("lookupNode", node)
    except LookupError:
        return None


def condition_of(node: str) -> Optional[str]:
    """Return whether the node is ALIVE or FROZEN, or None if it has ended; raise NO_ANSWER for the master."""
    uri = address_of(node)
    if not uri or not is_reachable(uri):
        return None
    try:
        return ALIVE if ask(proxy(uri), "getName") == node else None  # else another program has its port
    except socket.timeout:
        return FROZEN
    except NO_ANSWER:
        return None


def require_master(start: str = "roscore") -> None:
    """End the program with one sentence if no ROS master answers. start: the command that starts one."""
    try:
        ask_master("getPid")
    except socket.timeout:
        sys.exit(NOT_ANSWERING.format(master_uri()))
    except NO_ANSWER:
        sys.exit(f"No ROS master at {master_uri()}. Start one in another terminal: {start}")


def require_name(node: str) -> None:
    """End the program with one sentence if a node with this name, such as /jetbot_controller, already runs.

    Of two that live, the master would end the first.
    """
    condition = condition_of(node)
    if condition:
        advice = SECOND_ONE.get(node.rpartition("/")[2], "")
        sys.exit(f"The node {node} {condition}. End it first: Ctrl-C in its terminal; after Ctrl-Z, fg, then Ctrl-C. "
                 f"{advice}".rstrip())
