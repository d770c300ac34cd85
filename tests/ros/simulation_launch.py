#!/usr/bin/env python3
"""simulation.launch: the simulated robot has the controller's board and units, and one node publishes odom."""

import math
from pathlib import Path

import rosgraph
import rospy
import tf2_ros
from nav_msgs.msg import Odometry

from harness import START_TIMEOUT, RobotTest, main


class SimulationLaunch(RobotTest):
    def simulate(self, *arguments):
        """Start simulation.launch without RViz."""
        self.velocity = None
        self.addCleanup(rospy.Subscriber("odom", Odometry, self.keep_velocity).unregister)
        self.launch("simulation", "simulation.launch", f"port:=fake:{self.bus}", "rviz:=false", *arguments)
        self.wait_for_controller()

    def keep_velocity(self, odometry):
        self.velocity = odometry.twist.twist.linear.x, odometry.twist.twist.angular.z

    def assert_drives(self, command, velocity):
        """Repeat the command until odom has this velocity in m/s and rad/s."""
        def driving():
            self.command(*command)
            return self.velocity and all(abs(now - wanted) < 0.02 for now, wanted in zip(self.velocity, velocity))
        self.wait_for(driving, START_TIMEOUT, f"a velocity of {velocity}")

    def test_a_command_is_a_fraction_of_full_power(self):
        self.simulate()
        self.assert_drives((0.5, 0.1), (0.5 * 0.6, 2 * 0.1 * 0.6 / 0.1125))

    def test_simulates_the_board_of_the_configuration_file(self):
        config = Path(self.folder, "robot.yaml")
        config.write_text("board: sparkfun")
        self.simulate(f"config:={config}")
        self.assert_drives((0.5, 0.0), (0.3, 0.0))

    def test_the_controller_of_a_jetbot_pro_alone_publishes_odom(self):
        frames = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(frames)
        self.addCleanup(listener.unregister)
        self.simulate("board:=jetbot_pro")
        self.assert_drives((0.4, 0.2), (0.4, 0.2))
        self.assertEqual(dict(rosgraph.Master(rospy.get_name()).getSystemState()[0])["/odom"], ["/jetbot_controller"])
        self.wait_for(lambda: heading(frames) > 0.04, START_TIMEOUT, "the simulated robot to turn to the left")


def heading(frames):
    """Return the heading of the simulated robot on the map in rad, 0 before it is known."""
    if not frames.can_transform("map", "left_wheel", rospy.Time()):
        return 0.0
    return 2 * math.asin(frames.lookup_transform("map", "base_footprint", rospy.Time()).transform.rotation.z)


if __name__ == "__main__":
    main(SimulationLaunch)
