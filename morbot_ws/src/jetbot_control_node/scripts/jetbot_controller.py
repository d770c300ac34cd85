#!/usr/bin/env python3
"""ROS node: subscribes to cmd_vel and drives a JetBot's two wheels; if commands stop arriving, it stops the robot."""

# ruff: noqa: E402
import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while the imports run simply ends it; rospy might lose it

from jetbot_ros import launcher  # noqa: F401, I001  first of all: it reads who has started this process

import rospy
from geometry_msgs.msg import Twist

from jetbot.kinematics import mix
from jetbot_control_node import emergency_stops, node
from jetbot_control_node.publishers import Publishers
from jetbot_control_node.report import Report
from jetbot_ros import lifecycle


class JetBotController:
    def __init__(self):
        # Initialize the ROS node
        lifecycle.init_node("jetbot_controller")
        parameters = node.read_parameters()

        # Create a Robot object; a board that controls its wheel speeds itself takes a Twist unchanged
        self.robot = node.make_robot(parameters)
        self.geometry = () if self.robot.driver.closed_loop else (parameters["wheel_separation"],
                                                                  parameters["max_speed"])

        # The supervisor decides what may be driven, and stops the robot; the report says why
        self.commanders = Publishers("cmd_vel")
        supply = node.watch_supply(self.robot, parameters)
        self.report = Report(parameters, self.robot.driver, supply)
        self.supervisor = node.make_supervisor(self.robot, parameters, self.drive, self.commanders.names,
                                               self.report.change, supply)
        self.commanders.keep_asking(self.supervisor)

        # Subscribe to the topics and define the callback function; an earlier emergency stop comes before any command
        emergency_stops.subscribe(self.supervisor)
        rospy.Subscriber("cmd_vel", Twist, self.cmd_vel_callback, queue_size=1, tcp_nodelay=True)

    def cmd_vel_callback(self, msg):
        # Extract linear and angular velocity from the message
        self.supervisor.command(msg.linear.x, msg.angular.z, self.commanders.sender(msg))

    def drive(self, linear_x, angular_z):
        # Calculate wheel speeds: left = x - z, right = x + z, unless the parameters give other units
        left_speed, right_speed = mix(linear_x, angular_z, *self.geometry)
        # Set motor speeds
        self.robot.set_motors(left_speed, right_speed)

    def run(self):
        return node.run(self.supervisor, self.report)


if __name__ == "__main__":
    lifecycle.main(lambda: JetBotController().run())
