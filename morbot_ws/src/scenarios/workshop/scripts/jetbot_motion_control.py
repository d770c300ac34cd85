#!/usr/bin/env python3
"""ROS node: publishes one motion again and again, by default 0.5 ahead with a slight turn, ten times a second."""

import rospy
from geometry_msgs.msg import Twist


def main():
    rospy.init_node("jetbot_motion_control")
    motion = Twist()
    motion.linear.x = rospy.get_param("~linear", 0.5)
    motion.angular.z = rospy.get_param("~angular", 0.1)
    rate = rospy.Rate(rospy.get_param("~rate", 10))
    publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
    while not rospy.is_shutdown():
        publisher.publish(motion)
        rate.sleep()


if __name__ == "__main__":
    try:
        main()
    except rospy.ROSInterruptException:
        pass
