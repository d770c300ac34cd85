"""simulation.launch: the robot has the controller's board and units; one node publishes odom, one sends its tf."""

import math
import pathlib

import rosgraph
import rospy
import tf2_ros
from geometry_msgs.msg import Vector3
from nav_msgs.msg import Odometry, Path
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
        config = pathlib.Path(self.folder, "robot.yaml")
        config.write_text("board: waveshare_hat\ni2c_address: 0x61")
        self.simulate(f"config:={config}")
        self.assert_drives((0.5, 0.0), (0.3, 0.0))

    def test_the_controller_of_a_jetbot_pro_alone_publishes_odom_and_its_tf_and_they_agree_with_the_path(self):
        frames, transforms, paths = tf2_ros.Buffer(), self.record("/tf", TFMessage), self.record("path", Path)
        self.addCleanup(tf2_ros.TransformListener(frames).unregister)
        self.simulate("board:=jetbot_pro", "x:=1")
        self.assert_drives((2.0, 0.2), (2.0, 0.2))
        self.assertEqual(dict(rosgraph.Master(rospy.get_name()).getSystemState()[0])["/odom"], ["/jetbot_controller"])
        self.wait_for(lambda: position(frames).x > 2, START_TIMEOUT, "the simulated robot to drive")
        self.assertEqual({message._connection_header["callerid"] for message in transforms
                          if message.transforms[0].child_frame_id == "base_footprint"}, {"/jetbot_controller"})
        self.command(0)
        self.wait_for(lambda: self.odometry[-1].twist.twist.linear.x == 0, START_TIMEOUT, "the end of the motion")
        self.wait_for(lambda: abs(paths[-1].poses[-1].pose.position.x - position(frames).x) < 0.2, START_TIMEOUT,
                      "the path to end where the robot is")


def position(frames):
    """Return where the robot's left wheel is on the map, by tf; the origin before it is known."""
    if not frames.can_transform("map", "left_wheel", rospy.Time()):
        return Vector3()
    return frames.lookup_transform("map", "left_wheel", rospy.Time()).transform.translation
