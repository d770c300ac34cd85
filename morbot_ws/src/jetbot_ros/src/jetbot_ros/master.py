"""What a program asks the ROS master when it starts, with a time limit: rospy would wait forever."""

import socket
import sys
from typing import Optional

from .addresses import is_reachable, master_uri
from .xmlrpc import NO_ANSWER, proxy

TIMEOUT = 5.0  # s for an answer
SECOND_ONE = {  # by the last part of a node's name: what to do instead of starting a second one
    "jetbot_cockpit": "Its page has all robots of this ROS master.",
    "jetbot_controller": "A second robot is launched with robot_name:=NAME, in a <group ns> of yours with "
                         "namespace:=NAME."}
CALLER = "/jetbot_start"
ALIVE, FROZEN = "is already running", "is already running, but frozen (Ctrl-Z?)"


def require_master(start: str = "roscore") -> None:
    """End the program with one sentence if no ROS master answers. start: the command that starts one."""
    uri = master_uri()
    try:
        proxy(uri, TIMEOUT).getPid(CALLER)
    except socket.timeout:
        sys.exit(f"The ROS master at {uri} does not answer. Is it frozen (Ctrl-Z)? Continue it with fg, or restart it.")
    except NO_ANSWER:
        sys.exit(f"No ROS master at {uri}. Start one in another terminal: {start}")


def require_name(name: str) -> None:
    """End the program with one sentence if a node with this name, such as /jetbot_controller, already runs.

    The master also lists nodes that have died; of two that live, it would end the first.
    """
    condition = condition_of(name)
    if condition:
        advice = SECOND_ONE.get(name.rpartition("/")[2], "")
        sys.exit(f"The node {name} {condition}. End it first: Ctrl-C in its terminal; after Ctrl-Z, fg, then Ctrl-C. "
                 f"{advice}".rstrip())


def condition_of(name: str) -> Optional[str]:
    """Return whether the node with this name is ALIVE or FROZEN, or None if it has ended; raise NO_ANSWER."""
    code, _, uri = proxy(master_uri(), TIMEOUT).lookupNode(CALLER, name)
    return condition_at(uri, name) if code == 1 and is_reachable(uri) else None


def condition_at(uri: str, name: str) -> Optional[str]:
    """Return whether the node that was at this address is ALIVE or FROZEN, or None if it has ended."""
    try:
        return ALIVE if proxy(uri, TIMEOUT).getName(CALLER)[2] == name else None  # else another program has its port
    except socket.timeout:
        return FROZEN
    except NO_ANSWER:
        return None
