"""simulation.launch: the robot has the controller's board and units; one node publishes odom, one sends its tf."""

import math
from pathlib import Path

import rosgraph
import rospy
import tf2_ros
from nav_msgs.msg import Odometry
from tf2_msgs.msg import TFMessage

from harness import START_TIMEOUT, RobotTest


class SimulationLaunch(RobotTest):
    def simulate(self, *arguments):
        """Start simulation.launch without RViz."""
        self.odometry = self.record("odom", Odometry)
        self.launch("simulation", "simulation.launch", f"port:=fake:{self.bus}", "rviz:=false", *arguments)
        self.wait_for_controller()

    def assert_drives(self, command, velocity):
        """Repeat the command until odom has this velocity in m/s and rad/s."""
        def driving():
            self.command(*command)
            twist = self.odometry[-1].twist.twist if self.odometry else Odometry().twist.twist
            return math.hypot(twist.linear.x - velocity[0], twist.angular.z - velocity[1]) < 0.02
        self.wait_for(driving, START_TIMEOUT, f"a velocity of {velocity}")

    def test_a_command_is_a_fraction_of_full_power(self):
        self.simulate()
        self.assert_drives((0.5, 0.1), (0.5 * 0.6, 2 * 0.1 * 0.6 / 0.1125))

    def test_simulates_the_board_of_the_configuration_file(self):
        config = Path(self.folder, "robot.yaml")
        config.write_text("board: sparkfun")
        self.simulate(f"config:={config}")
        self.assert_drives((0.5, 0.0), (0.3, 0.0))

    def test_the_controller_of_a_jetbot_pro_alone_publishes_odom_and_the_simulator_tf(self):
        frames, transforms = tf2_ros.Buffer(), self.record("/tf", TFMessage)
        self.addCleanup(tf2_ros.TransformListener(frames).unregister)
        self.simulate("board:=jetbot_pro", "publish_tf:=true")
        self.assert_drives((0.4, 0.2), (0.4, 0.2))
        self.assertEqual(dict(rosgraph.Master(rospy.get_name()).getSystemState()[0])["/odom"], ["/jetbot_controller"])
        self.wait_for(lambda: heading(frames) > 0.04, START_TIMEOUT, "the simulated robot to turn to the left")
        self.assertEqual({message._connection_header["callerid"] for message in transforms
                          if message.transforms[0].child_frame_id == "base_footprint"}, {"/jetbot_simulator"})


def heading(frames):
    """Return the heading of the simulated robot on the map in rad, 0 before it is known."""
    if not frames.can_transform("map", "left_wheel", rospy.Time()):
        return 0.0
    return 2 * math.asin(frames.lookup_transform("map", "base_footprint", rospy.Time()).transform.rotation.z)
