#!/usr/bin/env python3
"""ROS node: publish one motion on cmd_vel at a steady rate."""

import rospy
from geometry_msgs.msg import Twist


def driver():
    rospy.init_node("jetbot_motion_control")
    linear = rospy.get_param("~linear", 0.5)    # m/s, forward
    angular = rospy.get_param("~angular", 0.1)  # rad/s, positive to the left
    rate = rospy.Rate(rospy.get_param("~rate", 10))  # Hz
    publisher = rospy.Publisher("cmd_vel", Twist, queue_size=10)
    while not rospy.is_shutdown():
        twist = Twist()
        twist.linear.x = linear
        twist.angular.z = angular
        publisher.publish(twist)
        rate.sleep()


if __name__ == "__main__":
    try:
        driver()
    except rospy.ROSInterruptException:
        pass
