"""What a program asks the ROS master when it starts, with a time limit: rospy would wait forever."""

import os
import socket
import sys
from typing import Optional
from urllib.parse import urlsplit

from jetbot import JetbotError

from .xmlrpc import NO_ANSWER, proxy

TIMEOUT = 5.0  # s for an answer
CALLER = "/jetbot_start"
ALIVE, FROZEN = "is running already", "is running already, but does not answer (frozen by Ctrl-Z?)"


def master_uri() -> str:
    """Return the master's address."""
    typed = [argument.partition(":=")[2] for argument in sys.argv if argument.startswith("__master:=")]
    return (typed or [os.environ.get("ROS_MASTER_URI")])[0] or "http://localhost:11311"


def require_master() -> None:
    """End the program with one sentence if no ROS master answers."""
    uri = master_uri()
    try:
        proxy(uri, TIMEOUT).getPid(CALLER)
    except socket.timeout:
        sys.exit(f"The ROS master at {uri} does not answer. Is it frozen (Ctrl-Z)? Continue it with fg, or restart it.")
    except NO_ANSWER:
        sys.exit(f"No ROS master at {uri}. Start one in another terminal: roscore")


def require_name(name: str) -> None:
    """Raise JetbotError if a node with this name, such as /jetbot_controller, runs already.

    The master also lists nodes that have died; ROS would end the first of two that live.
    """
    condition = condition_of(name)
    if condition:
        raise JetbotError(f"a node {name} {condition}", f"End it first: Ctrl-C in its terminal, or rosnode kill {name}")


def condition_of(name: str) -> Optional[str]:
    """Return whether the node with this name is ALIVE or FROZEN, or None if it has ended; raise one of NO_ANSWER."""
    code, _, uri = proxy(master_uri(), TIMEOUT).lookupNode(CALLER, name)
    return condition_at(uri, name) if code == 1 else None


def condition_at(uri: str, name: str) -> Optional[str]:
    """Return whether the node that was at this address is ALIVE or FROZEN, or None if it has ended."""
    try:
        parts = urlsplit(uri)
        socket.create_connection((parts.hostname, parts.port), TIMEOUT).close()  # fails if its computer is gone, too
    except (OSError, ValueError):
        return None
    try:
        return ALIVE if proxy(uri, TIMEOUT).getName(CALLER)[2] == name else None  # else another program has its port
    except socket.timeout:
        return FROZEN
    except NO_ANSWER:
        return None
