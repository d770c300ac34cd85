"""The simulated robot among walls and lines: stopped, drawn, seen by its sensor, and where it really is."""

import rospy
from geometry_msgs.msg import Pose2D
from nav_msgs.msg import Odometry
from std_msgs.msg import Float32MultiArray, String
from visualization_msgs.msg import Marker, MarkerArray

from harness import START_TIMEOUT, RobotTest, program, read
from jetbot import Robot
from simulation.recording import pose_of
from simulation.world import FOOTPRINT

STEP = 10_000_000  # ns
WORLD = """
walls: [[[0.1, -1], [0.1, 1]]]
lines: [[[-1, 0], [1, 0]]]
origin: [1, 0, 0]
"""


class World(RobotTest):
    def setUp(self):
        super().setUp()
        self.truth = self.record("jetbot_simulator/ground_truth", Odometry)
        self.drawn = self.record("world", MarkerArray, lambda message: [
            (marker.ns, len(marker.points)) for marker in message.markers if marker.action == Marker.ADD])
        self.seen = self.record("line", Float32MultiArray)
        self.worlds = rospy.Publisher("jetbot_simulator/world", String, queue_size=1)
        self.addCleanup(self.worlds.unregister)
        self.simulator = self.start(program("simulation", "simulator.py"), f"_i2c_bus:=fake:{self.bus}",
                                    "_world:=parking.yaml", "_x:=1", "_y:=0.4")
        self.wait_for(lambda: self.truth and self.drawn and self.seen and self.worlds.get_num_connections(),
                      START_TIMEOUT, "the simulator")

    def load(self, text, *drawn):
        """Send a world, and wait until it is drawn like this."""
        self.worlds.publish(text)
        self.wait_for(lambda: self.drawn[-1] == list(drawn), 5.0, f"{drawn} instead of {self.drawn[-1]}")

    def speed(self):
        return self.truth[-1].twist.twist.linear.x

    def test_a_wall_stops_it_and_it_backs_off(self):
        x = 1.2 - FOOTPRINT.right
        with Robot("adafruit", f"fake:{self.bus}") as robot:
            robot.set_motors(0.5, 0.5)
            self.wait_for(lambda: "touched a wall" in read(self.simulator), START_TIMEOUT, "the wall")
            self.wait_for(lambda: 0 < x - pose_of(self.truth[-1]).x < 1e-4 and self.speed() == 0, 5.0, "the stop")
            robot.set_motors(-0.5, -0.5)
            self.wait_for(lambda: pose_of(self.truth[-1]).x < x - 0.1 and self.speed() < -0.1, 5.0, "the way back")
        self.assertEqual(read(self.simulator).count("touched a wall"), 1)
        self.wait_for(lambda: self.speed() == 0, 5.0, "the end of the motion")
        stamps = [message.header.stamp.to_nsec() for message in self.truth]
        self.assertEqual({(stamp - stamps[0]) % STEP for stamp in stamps}, {0})
        self.assertLess(abs(rospy.Time.now().to_nsec() - stamps[-1]), 1e9)
        self.assertEqual((self.truth[0].header.frame_id, self.truth[0].child_frame_id), ("map", "base_footprint"))

    def test_worlds_are_loaded_by_topic_a_bad_one_changes_nothing_and_an_empty_one_ends_it(self):
        self.assertEqual(self.drawn, [[("walls", 4)]])
        self.load(WORLD, ("walls", 2), ("lines", 2))
        self.worlds.publish("walls: [[[0, 0]]]")
        warning = "The world that was sent cannot be used: polyline 1 of walls must be a list of two points"
        self.wait_for(lambda: read(self.simulator).count(warning) == 1, 5.0, warning)
        self.assertEqual(self.drawn[-1], [("walls", 2), ("lines", 2)])
        self.load("", ("walls", 4))

    def test_the_sensor_sees_the_tape_below_the_robot(self):
        place = rospy.Publisher("jetbot_simulator/set_pose", Pose2D, queue_size=1)
        self.addCleanup(place.unregister)
        self.wait_for(place.get_num_connections, START_TIMEOUT, "the simulator to subscribe")
        self.load(WORLD, ("walls", 2), ("lines", 2))
        for y, seen in ((0.0, (0.75, 0, 0.75)), (0.015, (1, 0.75, 0)), (-0.015, (0, 0.75, 1)), (0.5, (1, 1, 1))):
            place.publish(0.5, y, 0.0)
            self.wait_for(lambda seen=seen: tuple(round(eye, 4) for eye in self.seen[-1].data) == seen, 5.0,
                          f"{seen} instead of {self.seen[-1].data}")
        self.assertEqual(self.seen[-1].layout.dim[0].label, "left, middle, right")
