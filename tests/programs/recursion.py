#!/usr/bin/env python3
import rospy
from geometry_msgs.msg import Twist


def koch(level, seconds):
    if level == 0:
        move(0.4, 0, seconds)
        return 1
    total = 0
    for turn in (0, 0.3, -0.6, 0.3):
        if turn:
            move(0, turn, 0.15)
        total += koch(level - 1, seconds * 0.8)
    return total


def move(x, z, seconds):
    motion.linear.x, motion.angular.z = x, z
    publisher.publish(motion)
    rospy.sleep(seconds)


rospy.init_node("recursion")
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
motion = Twist()
while publisher.get_num_connections() == 0:
    rospy.sleep(0.1)
print(koch(1, 0.5), "straight lines")
move(0, 0, 0.1)
