"""Repairs of rospy's connections: none is lost while its publisher runs, none hangs, none is a stranger's."""

import contextlib
import errno
import math
import socket
import struct
import threading
import time
from typing import Dict, Optional, Tuple
from urllib.parse import urlsplit

import rosgraph
import rospy
from rospy.exceptions import TransportException
from rospy.impl import tcpros_pubsub
from rospy.impl.masterslave import ROSHandler
from rospy.impl.registration import RegManager, get_topic_manager
from rospy.impl.tcpros_base import TCPROSServer, TCPROSTransport, TCPServer
from rospy.impl.tcpros_pubsub import TCPROSHandler

from jetbot.host import is_loopback, is_this_host

from . import failures
from .master import NO_ANSWER, BoundedTransport, master_uri, proxy, system_state

MASTER_TIMEOUT = 5.0  # s for an answer to rospy
HEADER_TIMEOUT = 5.0  # s that a connection may pause in its header
MAX_HEADER = 2 ** 20  # bytes; it holds the definition of a message
WARN_INTERVAL = 10.0  # s
RECONNECT_DELAY = 0.1     # s until a publisher that ends no longer takes connections
RECONNECT_INTERVAL = 1.0  # s between two connections to a publisher that breaks them off

# By topic and publisher's address, the name of the program there, until it ends: what it latches, it has sent before.
# A new tuple for each connection, so that an answer of the master's from before that one ends nothing.
heard: Dict[Tuple[str, str], Tuple[str]] = {}


def repair() -> None:
    """Install all repairs; call it before the node is initialized."""
    stay_on_this_host()
    bound_headers()
    bound_questions()
    reconnect()
    connect_once()
    for kind, method in (RegManager, "start"), (TCPServer, "run"):  # rospy's threads that connect to others, and accept
        setattr(kind, method, failures.lasting(getattr(kind, method), rospy.core.is_shutdown_requested))
    need_sockets()


def need_sockets() -> None:
    """End this process if it cannot have a socket: rospy would give a publisher or its own server up, a deaf node."""
    for owner, step in (socket.socket, "__init__"), (socket.socket, "connect"), (socket, "getaddrinfo"):
        setattr(owner, step, failures.vital(getattr(owner, step)))


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
        tried = -math.inf
        receive(connection, host, port, publisher, callback, topic)
        while connection:
            time.sleep(max(RECONNECT_DELAY, tried + RECONNECT_INTERVAL - time.monotonic()))
            tried, connection = time.monotonic(), connect_again(connection, host, port, topic)
            if connection and not connection.done:
                connection.receive_loop(callback)

    tcpros_pubsub.robust_connect_subscriber = receive_and_reconnect


def connect_again(broken: TCPROSTransport, host: str, port: int, topic: str) -> Optional[TCPROSTransport]:
    """Return a new connection to the publisher of a broken one, or None if that has ended, or is connected already.

    Return the broken one, to be tried again, if the publisher does not answer now. It is asked where it publishes, and
    not at its XML-RPC port: Linux may have given that out again, and a program that gets such a question where it
    publishes takes no connection any more.
    """
    subscriber, name, address = get_topic_manager().get_subscriber_impl(topic), broken.callerid_pub, broken.endpoint_id
    if not subscriber:
        return None
    known = heard.get((topic, address))
    subscriber.remove_connection(broken)  # rospy forgets that if a publisher ends before it has answered
    with contextlib.suppress(*NO_ANSWER):
        if name not in system_state()[0].get(topic, ()):
            if heard.get((topic, address)) is known:
                heard.pop((topic, address), None)
            return None
        if subscriber.has_connection(address):
            return None
        new = TCPROSTransport(tcpros_pubsub.TCPROSSub(topic, subscriber.data_class, subscriber.queue_size,
                                                      subscriber.buff_size, subscriber.tcp_nodelay), topic)
        try:
            new.connect(host, port, address, HEADER_TIMEOUT)
        except TransportException as error:
            if f"[Errno {errno.ECONNREFUSED}]" in str(error):  # it was killed
                # Struck off the list, as by `rosnode cleanup`, so that nobody asks who has its port next
                proxy(master_uri()).unregisterPublisher(name, topic, address)
            return broken
        if new.callerid_pub == name and subscriber.add_connection(new):
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
