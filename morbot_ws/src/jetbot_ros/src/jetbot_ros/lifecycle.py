"""The start and the end of a node: one clear error at most, no wait for a master that hangs, no stranger's message."""

import contextlib
import os
import re
import socket
import struct
import sys
import threading
from typing import Callable
from urllib.parse import urlsplit

import rosgraph
import rospy
from rospy.impl.masterslave import ROSHandler
from rospy.impl.registration import RegManager
from rospy.impl.tcpros_base import TCPROSServer, TCPServer
from rospy.impl.tcpros_pubsub import TCPROSHandler

from jetbot import InvalidValue, JetbotError
from jetbot.host import is_loopback, is_this_host

from . import failures
from .master import require_master, require_name
from .node_parameters import fake_advice, public_words

HEADER_TIMEOUT = 5.0  # s that a connection may pause in its header
MAX_HEADER = 2 ** 20  # bytes; it holds the definition of a message
WARN_INTERVAL = 10.0  # s


def init_node(name: str) -> None:
    """Initialize the node; end the program with one sentence if there is no master, or a node of this name runs.

    Raise InvalidValue for a name that ROS does not take.
    """
    require_master()
    require_name(rosgraph.names.resolve_name(rospy.names.get_mappings().get("__name", name), rospy.get_caller_id()))
    stay_on_this_host()
    bound_headers()
    for kind, method in (RegManager, "start"), (TCPServer, "run"):  # rospy's threads that connect to others, and accept
        setattr(kind, method, failures.lasting(getattr(kind, method), rospy.core.is_shutdown_requested))
    # rospy's own signal handlers talk to the master before anything stops, and wait forever if that hangs.
    rospy.init_node(name, argv=public_words(), disable_signals=True)
    namespace = rospy.get_namespace()
    if not re.fullmatch(r"/([A-Za-z]\w*/)*", namespace, re.ASCII):  # ROS's programs in C++ refuse any other
        raise InvalidValue(f"a robot cannot be named {namespace.strip('/')}",
                           "Begin with a letter, and use letters, digits and _.")


def stay_on_this_host() -> None:
    """Connect to the publishers of this host alone, if this node's own address (ROS_HOSTNAME, ROS_IP) is a loopback.

    Whoever can reach the master makes it list publishers anywhere: a page in a browser of this computer can.
    """
    if not is_loopback(rosgraph.network.get_host_name()):
        return
    connect_topic, create_transport = ROSHandler._connect_topic, TCPROSHandler.create_transport

    def connect_topic_here(handler, topic, address):
        if is_this_host(urlsplit(address).hostname):
            return connect_topic(handler, topic, address)
        return refuse(address)

    def create_transport_here(handler, topic, address, protocol):
        if is_this_host(protocol[1]):
            return create_transport(handler, topic, address, protocol)
        return refuse(protocol[1])

    ROSHandler._connect_topic, TCPROSHandler.create_transport = connect_topic_here, create_transport_here


def refuse(address: object) -> tuple:
    """Log that the publisher at this address is of another host; return what rospy takes for a failure."""
    rospy.logwarn_throttle(WARN_INTERVAL, f"refused a publisher at {str(address)[:80]!a}: "
                                          "ROS_HOSTNAME limits this robot to its own computer")
    return 0, "of another host", 0


def bound_headers() -> None:
    """Let a connection that sends no header, or one without end, block and slow down nobody else."""
    answer = TCPROSServer._tcp_server_callback

    def answer_in_time(server, connection, client):
        connection.settimeout(HEADER_TIMEOUT)  # rospy resets it after the header
        with contextlib.suppress(OSError, struct.error):
            size, = struct.unpack("<I", connection.recv(4, socket.MSG_PEEK))
            if size <= MAX_HEADER:
                return answer(server, connection, client)
        return connection.close()

    def answer_apart(*arguments):
        threading.Thread(target=answer_in_time, args=arguments, daemon=True).start()

    TCPROSServer._tcp_server_callback = answer_apart


def leave(code: int) -> None:
    """End the process now: rospy's threads, which have nothing left to do, would take another second."""
    with contextlib.suppress(OSError):  # the terminal is closed
        sys.stdout.flush()
    os._exit(1 if failures.has_failed() else code)


def main(start: Callable[[], int]) -> None:
    """Run a node's ``start`` and exit with its code; an error that the user can fix ends it with one sentence."""
    try:
        leave(start())
    except JetbotError as error:
        rospy.logfatal(error.text(fake_advice))
        sys.exit(1)
    except OSError as error:
        require_master()  # it may have ended meanwhile
        if isinstance(error, BrokenPipeError):  # `| head`: nobody reads the log
            leave(1)
        raise
