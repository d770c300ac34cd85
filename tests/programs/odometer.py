#!/usr/bin/env python3
import math

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

start = None
driven = 0.0


def odom(message):
    global start, driven
    position = message.pose.pose.position
    if start is None:
        start = position.x, position.y
    driven = math.hypot(position.x - start[0], position.y - start[1])


rospy.init_node("odometer")
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("odom", Odometry, odom)
rate = rospy.Rate(20)
while start is None or publisher.get_num_connections() == 0:
    rate.sleep()
motion = Twist()
motion.linear.x = 0.5
while driven < 1.0 and not rospy.is_shutdown():
    publisher.publish(motion)
    rate.sleep()
publisher.publish(Twist())
rate.sleep()
