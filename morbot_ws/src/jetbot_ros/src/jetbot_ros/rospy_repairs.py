"""Repairs of rospy's connections: none is lost while its publisher runs, none hangs, none is another computer's."""

import contextlib
import socket
import struct
import threading

import rosgraph
import rospy
from rospy.impl.tcpros_base import TCPROSServer, TCPServer

from . import failures, links
from .master import BoundedTransport

MASTER_TIMEOUT = 5.0  # s for an answer to rospy
HEADER_TIMEOUT = 5.0  # s that a connection may pause in its header
MAX_HEADER = 2 ** 20  # bytes; it holds the definition of a message


def repair() -> None:
    """Install all repairs; call it before the node is initialized."""
    links.install()
    bound_headers()
    bound_questions()
    TCPServer.run = failures.lasting(TCPServer.run, rospy.core.is_shutdown_requested)  # it accepts connections


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
