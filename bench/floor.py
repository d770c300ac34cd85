#!/usr/bin/env python3
"""The least that a node of rospy can do: take the newest command, and write it as one block of six bytes."""

import struct

import rospy
from geometry_msgs.msg import Twist

from jetbot.fake.bus import FakeBus

ADDRESS, MODE1, AUTO_INCREMENT, FIRST_OUTPUT = 0x60, 0x00, 0x20, 0x06


def open_driver(folder):
    """A function of the speeds (left, right), in [-1, 1], that leaves them in the chip on the fake bus in a folder."""
    bus = FakeBus(folder)
    bus.write_byte_data(ADDRESS, MODE1, AUTO_INCREMENT)
    return lambda left, right: bus.write_i2c_block_data(
        ADDRESS, FIRST_OUTPUT, struct.pack("<3h", int(4096 * left), int(4096 * right), 0))


if __name__ == "__main__":
    rospy.init_node("jetbot_controller")
    set_motors = open_driver(rospy.get_param("~folder"))
    rospy.Subscriber("cmd_vel", Twist, lambda twist: set_motors(twist.linear.x - twist.angular.z,
                                                                twist.linear.x + twist.angular.z),
                     queue_size=1, tcp_nodelay=True)
    rospy.spin()
