#!/usr/bin/env python3
import rospy
from geometry_msgs.msg import Twist


class TooFast(ValueError):
    pass


def set_speed(x, z=0.0):
    if abs(x) > 1:
        raise TooFast(f"{x} is more than 1")
    motion = Twist()
    motion.linear.x, motion.angular.z = x, z
    publisher.publish(motion)


rospy.init_node("failing")
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
while publisher.get_num_connections() == 0:
    rospy.sleep(0.1)
try:
    for speed in (0.3, 0.5, 1.2, 0.7):
        try:
            set_speed(speed)
        except TooFast as problem:
            print("no:", problem)
            set_speed(-0.2, 0.1)
        rospy.sleep(0.4)
    set_speed(1 / 0)
except ZeroDivisionError:
    set_speed(0.1)
    rospy.sleep(rospy.Duration(0.3))
finally:
    set_speed(0)
    rospy.sleep(0.1)
