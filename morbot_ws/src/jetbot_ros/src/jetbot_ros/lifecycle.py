"""The start and the end of a node: one clear error at most, no wait for a master that hangs, no stranger's message."""

import contextlib
import re
import socket
import struct
import sys
import threading
import time
from typing import Callable, Dict, Optional, Tuple
from urllib.parse import urlsplit

import rosgraph
import rospy
from rospy.exceptions import TransportException
from rospy.impl import tcpros_pubsub
from rospy.impl.masterslave import ROSHandler
from rospy.impl.registration import RegManager, get_topic_manager
from rospy.impl.tcpros_base import TCPROSServer, TCPROSTransport, TCPServer
from rospy.impl.tcpros_pubsub import TCPROSHandler

from jetbot import InvalidValue, JetbotError
from jetbot.host import is_loopback, is_this_host

from . import failures
from .master import NO_ANSWER, NOT_ANSWERING, BoundedTransport, master_uri, require_master, require_name, system_state
from .node_parameters import fake_advice, public_words

MASTER_TIMEOUT = 5.0  # s for an answer to rospy
HEADER_TIMEOUT = 5.0  # s that a connection may pause in its header
MAX_HEADER = 2 ** 20  # bytes; it holds the definition of a message
WARN_INTERVAL = 10.0  # s
RECONNECT_DELAY = 0.1     # s until a publisher that ends no longer takes connections
RECONNECT_INTERVAL = 1.0  # s between two connections to a publisher that breaks them off

# By topic and publisher's address, the name of the program there, until it ends: what it latches, it has sent before.
heard: Dict[Tuple[str, str], str] = {}


def init_node(name: str) -> None:
    """Initialize the node; end the program with one sentence if there is no master, or a node of this name runs.

    Raise InvalidValue for a name that ROS does not take.
    """
    require_master()
    require_name(rosgraph.names.resolve_name(rospy.names.get_mappings().get("__name", name), rospy.get_caller_id()))
    stay_on_this_host()
    bound_headers()
    bound_questions()
    reconnect()
    connect_once()
    for kind, method in (RegManager, "start"), (TCPServer, "run"):  # rospy's threads that connect to others, and accept
        setattr(kind, method, failures.lasting(getattr(kind, method), rospy.core.is_shutdown_requested))
    for owner, step in (socket.socket, "__init__"), (socket.socket, "connect"), (socket, "getaddrinfo"):
        setattr(owner, step, failures.vital(getattr(owner, step)))  # rospy would give a publisher up: a deaf node
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


def reconnect() -> None:
    """Connect again to a publisher whose connection breaks off while it runs: rospy would stay deaf to it."""
    receive = tcpros_pubsub.robust_connect_subscriber

    def receive_and_reconnect(connection, host, port, publisher, callback, topic):
        began = time.monotonic()
        receive(connection, host, port, publisher, callback, topic)
        while connection:
            time.sleep(max(RECONNECT_DELAY, began + RECONNECT_INTERVAL - time.monotonic()))
            began, connection = time.monotonic(), connect_again(connection, host, port, topic)
            if connection:
                connection.receive_loop(callback)

    tcpros_pubsub.robust_connect_subscriber = receive_and_reconnect


def connect_again(broken: TCPROSTransport, host: str, port: int, topic: str) -> Optional[TCPROSTransport]:
    """Return a new connection to the publisher of a broken one, or None if that has ended, or is connected already.

    It is asked where it publishes, and not at its XML-RPC port: Linux may have given that out again, and a program that
    gets such a question where it publishes takes no connection any more.
    """
    subscriber = get_topic_manager().get_subscriber_impl(topic)
    if not subscriber:
        return None
    subscriber.remove_connection(broken)  # rospy forgets that if a publisher ends before it has answered
    with contextlib.suppress(*NO_ANSWER, TransportException):
        if broken.callerid_pub not in system_state()[0].get(topic, ()):
            heard.pop((topic, broken.endpoint_id), None)
            return None
        if subscriber.has_connection(broken.endpoint_id):
            return None
        new = TCPROSTransport(tcpros_pubsub.TCPROSSub(topic, subscriber.data_class, subscriber.queue_size,
                                                      subscriber.buff_size, subscriber.tcp_nodelay), topic)
        new.connect(host, port, broken.endpoint_id, HEADER_TIMEOUT)
        if new.callerid_pub == broken.callerid_pub and subscriber.add_connection(new):
            return new
        new.close()
    return None


def connect_once() -> None:
    """Connect to a publisher once, also if several threads do: rospy would drop the first connection, and its order."""
    create_transport, lock = TCPROSHandler.create_transport, threading.Lock()

    def create_first_transport(handler, topic, address, protocol):
        with lock:
            if get_topic_manager().get_subscriber_impl(topic).has_connection(address):
                return 1, "connected already", 0
            return create_transport(handler, topic, address, protocol)

    TCPROSHandler.create_transport = create_first_transport


def refuse(address: object) -> tuple:
    """Log that the publisher at this address is of another host; return what rospy takes for a failure."""
    rospy.logwarn_throttle(WARN_INTERVAL, f"refused a publisher at {str(address)[:80]!a}: "
                                          "ROS_HOSTNAME limits this robot to its own computer")
    return 0, "of another host", 0


def bound_questions() -> None:
    """Let no question of rospy's wait forever for a frozen master. A registration is tried again, others fail."""
    rospy.core.xmlrpcapi(rosgraph.get_master_uri())._ServerProxy__transport = BoundedTransport(MASTER_TIMEOUT)


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
