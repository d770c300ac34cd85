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
from jetbot_ros import contract, lifecycle


class JetBotController:
    def __init__(self):
        # Initialize the ROS node
        lifecycle.init_node(contract.CONTROLLER)
        parameters = node.read_parameters()

        # Create a Robot object
        self.robot = node.make_robot(parameters)
        self.geometry = node.geometry_of(self.robot, parameters)

        # The supervisor decides when to drive, and stops the robot; the report says why
        self.supervisor = Supervisor(self.robot, parameters["cmd_vel_timeout"],
                                     make_ramp(parameters, self.robot.driver))
        self.report = node.start_reporting(self.supervisor, parameters, self.geometry)

        # Subscribe to the topics and define the callback function; an earlier emergency stop comes before any command
        self.commanders = Commanders("cmd_vel", self.supervisor.disconnect)
        stop_topics.subscribe(self.supervisor)
        rospy.Subscriber("cmd_vel", Twist, self.cmd_vel_callback, queue_size=1, tcp_nodelay=True)
        self.commanders.keep_asking(self.supervisor)

    def cmd_vel_callback(self, msg):
        sender = self.commanders.sender(msg)
        if sender is None:
            return
        # Extract linear and angular velocity from the message
        linear_x, angular_z = msg.linear.x, msg.angular.z
        # Calculate motor speeds: left = x - z, right = x + z, unless the parameters give other units
        left_motor_speed, right_motor_speed = mix(linear_x, angular_z, *self.geometry)
        # Set motor speeds, and stop the motors when no command follows
        self.supervisor.command(left_motor_speed, right_motor_speed, sender)

    def run(self):
        return node.run(self.supervisor, self.report)


if __name__ == "__main__":
    lifecycle.main(lambda: JetBotController().run())
