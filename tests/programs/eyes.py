#!/usr/bin/env python3
import rospy
from geometry_msgs.msg import Twist
from std_msgs.msg import Float32MultiArray

eyes = None


def look(message):
    global eyes
    eyes = message.data


rospy.init_node("eyes")
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("line", Float32MultiArray, look, queue_size=1)
rate = rospy.Rate(10)
while eyes is None or publisher.get_num_connections() == 0:
    rate.sleep()
motion = Twist()
start = rospy.get_time()
while rospy.get_time() - start < 5:
    left, middle, right = eyes
    motion.linear.x = 0.25
    motion.angular.z = 0.08 * (right - left)
    publisher.publish(motion)
    rate.sleep()
publisher.publish(Twist())
rate.sleep()
