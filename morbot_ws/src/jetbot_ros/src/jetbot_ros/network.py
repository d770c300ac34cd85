"""What this node's connections accept, where rospy accepts more. Both functions go before ``rospy.init_node``."""

import contextlib
import socket
import struct
import threading
from urllib.parse import urlsplit

import rosgraph
import rospy
from rospy.impl.masterslave import ROSHandler
from rospy.impl.tcpros_base import TCPROSServer
from rospy.impl.tcpros_pubsub import TCPROSHandler

from jetbot.host import is_loopback, is_this_host

HEADER_TIMEOUT = 5.0  # s that a connection may pause in its header
MAX_HEADER = 2 ** 20  # bytes; it holds the definition of a message
WARN_INTERVAL = 10.0  # s


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
