#!/usr/bin/env python3
"""The workshop's own scripts, as a class and as functions, drive the wheels and stop them at their end."""

import os
import signal
import sys

from harness import START_TIMEOUT, RobotTest, main

AS_A_CLASS = """
import rospy
from geometry_msgs.msg import Twist
from jetbot import Robot

class Listener:
    def __init__(self):
        rospy.init_node('jetbot_controller', anonymous=True)
        self.robot = Robot()
        rospy.Subscriber('/cmd_vel', Twist, self.on_twist)
        rospy.spin()

    def on_twist(self, twist):
        self.robot.set_motors(twist.linear.x - twist.angular.z, twist.linear.x + twist.angular.z)

Listener()
"""

AS_FUNCTIONS = """
import rospy
from geometry_msgs.msg import Twist
from jetbot import Robot

def on_twist(twist, robot):
    robot.set_motors(twist.linear.x - twist.angular.z, twist.linear.x + twist.angular.z)

rospy.init_node('jetbot_controller', anonymous=True)
robot = Robot()
rospy.Subscriber('/cmd_vel', Twist, on_twist, callback_args=robot)
rospy.spin()
"""


class WorkshopScripts(RobotTest):
    def drives_and_stops(self, script):
        for ending in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL):
            with self.subTest(ending):
                process = self.start(sys.executable, "-c", script,
                                     env={**os.environ, "JETBOT_I2C_BUS": f"fake:{self.bus}"})
                self.wait_for_controller()
                self.command(0.5, 0.1)
                self.wait_for_wheels(0.4, 0.6)
                process.send_signal(ending)
                process.wait(START_TIMEOUT)
                self.wait_for_stop(within=1.5)
                self.wait_for(lambda: not self.commands().get_num_connections(), 5.0, "the script to unsubscribe")

    def test_class(self):
        self.drives_and_stops(AS_A_CLASS)

    def test_functions(self):
        self.drives_and_stops(AS_FUNCTIONS)


if __name__ == "__main__":
    main(WorkshopScripts)
