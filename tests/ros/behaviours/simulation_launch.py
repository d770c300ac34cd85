"""simulation.launch: the robot has the controller's board and units; one node publishes odom, one sends its tf."""

import math
import pathlib

import rospy
import tf2_ros
from geometry_msgs.msg import Vector3
from nav_msgs.msg import Odometry, Path
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

from harness import START_TIMEOUT, RobotTest, publishers
from simulation.recording import pose_of


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

    def assert_stops(self):
        """Command a stop, and wait until odom has it."""
        self.command(0)
        self.wait_for(lambda: self.odometry[-1].twist.twist.linear.x == 0, START_TIMEOUT, "the end of the motion")

    def test_open_loop_odometry_is_the_only_one_and_ends_where_the_robot_does(self):
        config = pathlib.Path(self.folder, "robot.yaml")
        config.write_text("{wheel_separation: 0.1125, max_speed: 0.6, publish_odom: true}")
        frames, transforms = tf2_ros.Buffer(), self.record("/tf", TFMessage)
        self.addCleanup(tf2_ros.TransformListener(frames).unregister)
        joints = self.record("joint_states", JointState)
        self.simulate(f"config:={config}", "x:=1")
        self.assert_drives((0.4, 0.5), (0.4, 0.5))
        self.wait_for(lambda: self.command(0.4, 0.5) or self.odometry[-1].pose.pose.position.y > 0.2, START_TIMEOUT,
                      "a part of a circle")
        self.assert_stops()
        self.assertEqual(publishers("/odom"), ["/jetbot_controller"])
        self.assertEqual(publishers("/joint_states"), ["/jetbot_controller"])
        self.assertEqual(senders(transforms, "base_footprint"), {"/jetbot_controller"})
        self.assertEqual(senders(transforms, "true_base_footprint"), {"/jetbot_simulator"})
        self.wait_for(lambda: near(frames, "base_footprint", "true_base_footprint", 0.1), 5.0, "the robot to arrive")
        first, last = self.odometry[0], self.odometry[-1]
        self.assertGreater(last.pose.covariance[0], first.pose.covariance[0])
        self.assertGreater(last.pose.covariance[35], first.pose.covariance[35])
        left, right = joints[-1].position
        self.assertAlmostEqual((right - left) * 0.03 / 0.1125, pose_of(last).yaw, delta=0.05)

    def test_the_controller_of_a_jetbot_pro_alone_publishes_odom_and_its_tf_and_they_agree_with_the_path(self):
        frames, transforms, paths = tf2_ros.Buffer(), self.record("/tf", TFMessage), self.record("path", Path)
        self.addCleanup(tf2_ros.TransformListener(frames).unregister)
        self.simulate("board:=jetbot_pro", "x:=1", "publish_odom:=true")  # which is for other boards
        self.assert_drives((2.0, 0.2), (2.0, 0.2))
        self.assertEqual(publishers("/odom"), ["/jetbot_controller"])
        self.assertEqual(publishers("/joint_states"), ["/jetbot_simulator"])
        self.wait_for(lambda: position(frames).x > 2, START_TIMEOUT, "the simulated robot to drive")
        self.assertEqual(senders(transforms, "base_footprint"), {"/jetbot_controller"})
        self.assert_stops()
        self.wait_for(lambda: abs(paths[-1].poses[-1].pose.position.x - position(frames).x) < 0.2, START_TIMEOUT,
                      "the path to end where the robot is")


def senders(transforms, child):
    """Return the names of the nodes that send this frame's transform."""
    return {message._connection_header["callerid"] for message in transforms
            if message.transforms[0].child_frame_id == child}


def near(frames, frame, other, distance):
    """Return whether the two frames are at most this many metres apart."""
    if not frames.can_transform(frame, other, rospy.Time()):
        return False
    between = frames.lookup_transform(frame, other, rospy.Time()).transform.translation
    return math.hypot(between.x, between.y) < distance


def position(frames):
    """Return where the robot's left wheel is on the map, by tf; the origin before it is known."""
    if not frames.can_transform("map", "left_wheel", rospy.Time()):
        return Vector3()
    return frames.lookup_transform("map", "left_wheel", rospy.Time()).transform.translation
