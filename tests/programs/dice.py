#!/usr/bin/env python3
import random

import rospy
from geometry_msgs.msg import Twist

random.seed(7)
rospy.init_node("dice")
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
while publisher.get_num_connections() == 0:
    rospy.sleep(0.1)
for throw in range(6):
    motion = Twist()
    motion.linear.x = random.choice([0.2, 0.3, 0.4, 0.5])
    motion.angular.z = round(random.uniform(-0.2, 0.2), 2)
    publisher.publish(motion)
    seconds = random.randint(2, 5) / 10
    print(throw, motion.linear.x, motion.angular.z, seconds)
    rospy.sleep(seconds)
publisher.publish(Twist())
rospy.sleep(0.1)
