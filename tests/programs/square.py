#!/usr/bin/env python3
import rospy
from geometry_msgs.msg import Twist

SIDES = 4


def drive(x, z, seconds):
    motion = Twist()
    motion.linear.x = x
    motion.angular.z = z
    for count in range(int(seconds * 10)):
        publisher.publish(motion)
        rate.sleep()


def side():
    drive(0.4, 0, 0.5)
    drive(0, 0.3, 0.4)


rospy.init_node("square")
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rate = rospy.Rate(10)
while publisher.get_num_connections() == 0:
    rate.sleep()
for number in range(SIDES):
    side()
publisher.publish(Twist())
rate.sleep()
