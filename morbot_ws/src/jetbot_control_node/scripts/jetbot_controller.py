#!/usr/bin/env python3
"""ROS node: subscribes to cmd_vel and drives a JetBot's two wheels; if commands stop arriving, it stops the robot."""

import jetbot_ros.boot

import rospy
from geometry_msgs.msg import Twist

from jetbot.kinematics import mix
from jetbot_control_node import node
from jetbot_control_node.control import stop_topics
from jetbot_control_node.control.commanders import Commanders
from jetbot_control_node.control.ramp import make_ramp
from jetbot_control_node.control.supervisor import Supervisor
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

        # The supervisor decides when to drive, and stops the robot; the report says why
        self.supervisor = Supervisor(self.robot, self.drive, parameters["cmd_vel_timeout"],
                                     make_ramp(parameters, self.robot.driver))
        self.report = node.start_reporting(self.supervisor, parameters)

        # Subscribe to the topics and define the callback function; an earlier emergency stop comes before any command
        self.commanders = Commanders("cmd_vel", self.supervisor.disconnect)
        stop_topics.subscribe(self.supervisor)
        rospy.Subscriber("cmd_vel", Twist, self.cmd_vel_callback, queue_size=1, tcp_nodelay=True)
        self.commanders.keep_asking(self.supervisor)

    def cmd_vel_callback(self, msg):
        # Extract linear and angular velocity from the message
        sender = self.commanders.sender(msg)
        if sender:
            self.supervisor.command(msg.linear.x, msg.angular.z, sender)

    def drive(self, linear_x, angular_z):
        # Calculate wheel speeds: left = x - z, right = x + z, unless the parameters give other units
        left_speed, right_speed = mix(linear_x, angular_z, *self.geometry)
        # Set motor speeds
        self.robot.set_motors(left_speed, right_speed)

    def run(self):
        return node.run(self.supervisor, self.report)


if __name__ == "__main__":
    lifecycle.main(lambda: JetBotController().run())
