"""The start and the end of a node: one clear error at most, no wait for a master that hangs."""

import contextlib
import os
import re
import signal
import socket
import sys
import threading
from typing import Callable

import rosgraph
import rospy

from jetbot import InvalidValue, JetbotError

from . import failures, rospy_repairs
from .master import NOT_ANSWERING, master_uri, require_master, require_name
from .node_parameters import fake_advice, public_words


def init_node(name: str) -> None:
    """Initialize the node; end the program with one sentence if there is no master, or a node of this name runs.

    Raise InvalidValue for a name that ROS does not take.
    """
    require_master()
    require_name(rosgraph.names.resolve_name(rospy.names.get_mappings().get("__name", name), rospy.get_caller_id()))
    rospy_repairs.repair()
    # rospy's own signal handlers talk to the master before anything stops, and wait forever if that hangs.
    rospy.init_node(name, argv=public_words(), disable_signals=True)
    namespace = rospy.get_namespace()
    if not re.fullmatch(r"/([A-Za-z]\w*/)*", namespace, re.ASCII):  # ROS's programs in C++ refuse any other
        raise InvalidValue(f"a robot cannot be named {namespace.strip('/')}",
                           "Begin with a letter, and use letters, digits and _.")


def ending() -> threading.Event:
    """Return what a signal that ends programs sets from now on, and the end of rospy."""
    ended = threading.Event()
    for signum in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(signum, lambda *_: ended.set())
    rospy.on_shutdown(ended.set)
    return ended


def leave_within(seconds: float) -> None:
    """End the process after this time if it has not ended by itself: the master may hang."""
    limit = threading.Timer(seconds, os._exit, [1])
    limit.daemon = True
    limit.start()


def leave(code: int) -> None:
    """End the process now: rospy's threads, which have nothing left to do, would take another second."""
    with contextlib.suppress(OSError):  # the terminal is closed
        sys.stdout.flush()
    failures.leave(code)


def main(start: Callable[[], int]) -> None:
    """Run a node's ``start`` and exit with its code; an error that the user can fix ends it with one sentence."""
    try:
        leave(start())
    except JetbotError as error:
        rospy.logfatal(error.text(fake_advice))
        sys.exit(1)
    except (OSError, rospy.ROSInitException) as error:
        if failures.is_lack(error):
            raise
        require_master()  # it may have ended meanwhile
        if isinstance(error, (socket.timeout, rospy.ROSInitException)):  # or have been frozen
            sys.exit(NOT_ANSWERING.format(master_uri()))
        if isinstance(error, BrokenPipeError):  # `| head`: nobody reads the log
            leave(1)
        raise
