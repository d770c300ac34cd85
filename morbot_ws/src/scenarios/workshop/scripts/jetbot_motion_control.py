#!/usr/bin/env python3
"""ROS node: publishes one motion again and again, by default 0.5 ahead with a slight turn, ten times a second."""

import sys

import rospy
from geometry_msgs.msg import Twist

from jetbot import InvalidValue
from jetbot_ros.parameters import NUMBER, POSITIVE, Parameter, checked

PARAMETERS = {
    "linear": Parameter(0.5, *NUMBER),   # m/s
    "angular": Parameter(0.1, *NUMBER),  # rad/s, to the left
    "rate": Parameter(10, *POSITIVE),    # Hz
}


def main():
    rospy.init_node("jetbot_motion_control")
    parameters = checked(rospy.get_param("~", {}), PARAMETERS)
    motion = Twist()
    motion.linear.x = parameters["linear"]
    motion.angular.z = parameters["angular"]
    rate = rospy.Rate(parameters["rate"])
    publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
    while not rospy.is_shutdown():
        publisher.publish(motion)
        rate.sleep()


if __name__ == "__main__":
    try:
        main()
    except rospy.ROSInterruptException:
        pass
    except InvalidValue as error:
        rospy.logfatal(error)
        sys.exit(1)
