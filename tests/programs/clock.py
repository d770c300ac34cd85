#!/usr/bin/env python3
import math

import rospy
from geometry_msgs.msg import Twist

rospy.init_node("clock")
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
while publisher.get_num_connections() == 0:
    rospy.sleep(0.1)
motion = Twist()
start = rospy.get_time()
while not rospy.is_shutdown():
    elapsed = rospy.get_time() - start
    if elapsed >= 2.0:
        break
    motion.linear.x = 0.5 if elapsed < 1.0 else -0.25
    motion.angular.z = 0.1 * math.copysign(1, math.sin(2 * math.pi * elapsed))
    publisher.publish(motion)
    rospy.sleep(0.05)
publisher.publish(Twist())
rospy.sleep(0.1)
