#!/usr/bin/env python3
"""Programs that command a robot until they are ended. Arguments: KIND TOPIC SPEED PORT.

teleop: as teleop_twist_keyboard, one command per key, in a terminal in which a key is held.
port: a standing order of a node at this XML-RPC port, which one program after the other uses.
"""

import os
import pty
import select
import sys
import time
import tty

import rospy
from geometry_msgs.msg import Twist, Vector3

KEY_INTERVAL = 0.1  # s
KEY_TIMEOUT = 0.7   # s without a key until the robot is stopped


def teleop(topic: str, speed: float) -> None:
    """Publish a command for each key."""
    rospy.init_node("teleop", anonymous=True)
    publisher = rospy.Publisher(topic, Twist, queue_size=1)
    tty.setraw(0)
    while not rospy.is_shutdown():
        key = select.select([0], [], [], KEY_TIMEOUT)[0] and os.read(0, 1)
        publisher.publish(Vector3(x=speed if key else 0.0), Vector3())


def hold_key() -> None:
    """Start this program in a terminal of its own, and press keys there until it has ended."""
    pid, terminal = pty.fork()
    if pid == 0:
        return
    while True:
        os.write(terminal, b"i")  # raises OSError once nobody reads
        if select.select([terminal], [], [], 0)[0]:
            os.read(terminal, 1024)
        time.sleep(KEY_INTERVAL)


def port(topic: str, speed: float, number: int) -> None:
    """Publish one command, latched."""
    rospy.init_node("port", anonymous=True, xmlrpc_port=number)
    rospy.Publisher(topic, Twist, queue_size=1, latch=True).publish(Vector3(x=speed), Vector3())
    rospy.spin()


if __name__ == "__main__":
    kind, where, wanted, xmlrpc_port = sys.argv[1:5]
    if kind == "port":
        port(where, float(wanted), int(xmlrpc_port))
    else:
        hold_key()
        teleop(where, float(wanted))
