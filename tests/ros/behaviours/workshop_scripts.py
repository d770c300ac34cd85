"""The workshop's own scripts, as a class and as functions, drive the wheels and stop them at their end."""

import os
import signal
import sys

from harness import START_TIMEOUT, RobotTest

HEAD = """
import rospy
from geometry_msgs.msg import Twist
from jetbot import Robot
"""

AS_A_CLASS = """
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
def on_twist(twist, robot):
    robot.set_motors(twist.linear.x - twist.angular.z, twist.linear.x + twist.angular.z)

rospy.init_node('jetbot_controller', anonymous=True)
robot = Robot()
rospy.Subscriber('/cmd_vel', Twist, on_twist, callback_args=robot)
rospy.spin()
"""


class WorkshopScripts(RobotTest):
    def test_drive_and_stop(self):
        for script in AS_A_CLASS, AS_FUNCTIONS:
            for ending in signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL:
                self.drive_and_stop(script, ending)

    def drive_and_stop(self, script, ending):
        environment = {**os.environ, "JETBOT_I2C_BUS": f"fake:{self.bus}"}
        process = self.start(sys.executable, "-c", HEAD + script, env=environment)
        self.wait_for_controller()
        self.command(0.5, 0.1)
        self.wait_for_wheels(0.4, 0.6)
        process.send_signal(ending)
        process.wait(START_TIMEOUT)
        self.wait_for_stop(within=1.5)
        self.wait_for(lambda: not self.commands().get_num_connections(), 5.0, "the script to unsubscribe")
