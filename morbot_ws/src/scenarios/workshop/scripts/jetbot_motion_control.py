#!/usr/bin/env python3
"""ROS node: publish one motion on cmd_vel at a steady rate."""

import sys

import rospy
from geometry_msgs.msg import Twist

from jetbot import InvalidValue
from jetbot.kinds import NUMBER, Kind, is_number
from jetbot_ros.parameters import Parameter, check_values

RATE = Kind(lambda value: is_number(value) and 0.1 <= value <= 1000, "a number from 0.1 to 1000")
PARAMETERS = {
    "linear": Parameter(0.5, NUMBER, "forward speed", "m/s"),
    "angular": Parameter(0.1, NUMBER, "turning speed, positive to the left", "rad/s"),
    "rate": Parameter(10, RATE, "rate of the commands", "Hz"),
}


def driver():
    rospy.init_node("jetbot_motion_control")
    motion = check_values(rospy.get_param("~", {}), PARAMETERS)
    publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
    rate = rospy.Rate(motion["rate"])
    while not rospy.is_shutdown():
        twist = Twist()
        twist.linear.x = motion["linear"]
        twist.angular.z = motion["angular"]
        publisher.publish(twist)
        rate.sleep()


if __name__ == "__main__":
    try:
        driver()
    except rospy.ROSInterruptException:
        pass
    except InvalidValue as error:
        rospy.logfatal(error)
        sys.exit(1)
