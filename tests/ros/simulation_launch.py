#!/usr/bin/env python3
"""simulation.launch: the simulated robot has the controller's board and units, and odom one publisher."""

import os

import rosgraph
import rospy
import tf2_ros
from nav_msgs.msg import Odometry

from harness import START, RobotTest, main


class SimulationLaunch(RobotTest):
    def setUp(self):
        super().setUp()
        self.velocities = []
        self.addCleanup(rospy.Subscriber("odom", Odometry, self.keep_velocity).unregister)

    def keep_velocity(self, odometry):
        self.velocities.append((odometry.twist.twist.linear.x, odometry.twist.twist.angular.z))

    def simulate(self, *arguments):
        """Start simulation.launch without RViz."""
        self.launch("simulation", "simulation.launch", f"port:=fake:{self.bus}", "rviz:=false", *arguments)
        self.wait_for_controller()

    def assert_velocity(self, linear, angular):
        self.wait_for(lambda: self.velocities and abs(self.velocities[-1][0] - linear) < 0.01
                      and abs(self.velocities[-1][1] - angular) < 0.05, START,
                      f"{linear} m/s and {angular} rad/s; now {self.velocities[-1:]}")

    def test_a_command_is_a_fraction_of_full_power(self):
        self.simulate("motion:=true")  # left 0.4 and right 0.6 of 0.6 m/s
        self.assert_velocity(0.3, 0.12 / 0.1125)

    def test_has_the_board_of_the_configuration_file(self):
        config = os.path.join(self.folder, "robot.yaml")
        with open(config, "w") as file:
            file.write("board: sparkfun")
        self.simulate("motion:=true", "angular:=0", f"config:={config}")
        self.assert_velocity(0.3, 0.0)

    def test_a_jetbot_pro_publishes_odom_itself(self):
        frames = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(frames)
        self.addCleanup(listener.unregister)
        self.simulate("motion:=true", "board:=jetbot_pro", "linear:=0.4", "angular:=1.0")
        self.assert_velocity(0.4, 1.0)
        publishers = dict(rosgraph.Master(rospy.get_name()).getSystemState()[0])["/odom"]
        self.assertEqual(publishers, ["/jetbot_controller"])
        self.wait_for(lambda: self.turned(frames), START, "the simulated robot to turn to the left")

    def turned(self, frames):
        return (frames.can_transform("odom", "left_wheel", rospy.Time())
                and frames.lookup_transform("odom", "base_footprint", rospy.Time()).transform.rotation.z > 0.1)


if __name__ == "__main__":
    main(SimulationLaunch)
