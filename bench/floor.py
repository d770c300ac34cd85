#!/usr/bin/env python3
"""A bare rospy subscriber: takes the newest command and writes one block of six bytes."""

import struct
from typing import Callable

import rospy
from geometry_msgs.msg import Twist

from jetbot.fake.bus import FakeBus

ADDRESS, MODE1, MODE1_AI, LED0_ON_L = 0x60, 0x00, 0x20, 0x06


def open_driver(folder: str) -> Callable[[float, float], None]:
    """Return the function that writes the speeds left, right to the chip; see wire.open_driver."""
    bus = FakeBus(folder)
    bus.write_byte_data(ADDRESS, MODE1, MODE1_AI)
    return lambda left, right: bus.write_i2c_block_data(
        ADDRESS, LED0_ON_L, struct.pack("<3h", int(4096 * left), int(4096 * right), 0))


if __name__ == "__main__":
    rospy.init_node("jetbot_controller")
    set_motors = open_driver(rospy.get_param("~folder"))
    rospy.Subscriber("cmd_vel", Twist, lambda twist: set_motors(twist.linear.x - twist.angular.z,
                                                                twist.linear.x + twist.angular.z),
                     queue_size=1, tcp_nodelay=True)
    rospy.spin()
