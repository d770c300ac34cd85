"""The simulator's topics: where the robot is, the world around it, what it sees, and what puts it elsewhere."""

import math
import os
from pathlib import Path

import rospy
from geometry_msgs.msg import Pose2D
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CameraInfo, CompressedImage
from std_msgs.msg import Float32MultiArray, String
from std_srvs.srv import Empty
from visualization_msgs.msg import Marker, MarkerArray

from harness import START_TIMEOUT, SharedRobotTest, program, read
from jetbot import Robot, bgr8_to_jpeg
from jetbot.camera.lens import focal_length
from jetbot.kinematics import Pose
from jetbot_ros.ros_messages import pose_of
from simulation.picture import render
from simulation.world import FOOTPRINT
from simulation.world_files import load

STEP = 10_000_000  # ns
WORLD = """
walls: [[[0.1, -1], [0.1, 1]]]
lines: [[[-1, 0], [1, 0]]]
origin: [1, 0, 0]
"""


class Simulator(SharedRobotTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.simulator = cls.shared.start(program("simulation", "simulator.py"), f"_i2c_bus:=fake:{cls.shared.bus}",
                                         "_world:=parking.yaml", "_x:=1", "_y:=0.4")

    def setUp(self):
        super().setUp()
        self.odometry = self.record("odom", Odometry)
        self.truth = self.record("jetbot_simulator/ground_truth", Odometry)
        self.drawn = self.record("world", MarkerArray, lambda message: [
            (marker.ns, len(marker.points)) for marker in message.markers if marker.action == Marker.ADD])
        self.seen = self.record("line", Float32MultiArray)
        self.wait_for(lambda: self.odometry and self.truth and self.drawn and self.seen, START_TIMEOUT, "the simulator")

    def publisher_of(self, topic, kind):
        """Return a publisher on a topic of the simulator, which is connected."""
        publisher = rospy.Publisher(f"jetbot_simulator/{topic}", kind, queue_size=1)
        self.addCleanup(publisher.unregister)
        self.wait_for(publisher.get_num_connections, START_TIMEOUT, "the simulator to subscribe")
        return publisher

    def wait_for_speed(self, speed, samples):
        self.wait_for(lambda: abs(samples[-1].twist.twist.linear.x - speed) < 0.001, 5.0, f"{speed} m/s")

    def wait_for_log(self, text):
        self.wait_for(lambda: text in read(self.simulator), 5.0, text)

    def test_it_drives_as_the_registers_say_up_to_a_wall_and_logs_that(self):
        self.wait_for_log("at x 1.00 m, y 0.40 m, heading 0 deg; left wheel 0.00 m/s, right wheel 0.00 m/s\n")
        x = 1.2 - FOOTPRINT.right
        with Robot("adafruit", f"fake:{self.bus}") as robot:
            robot.set_motors(0.5, 0.5)
            self.wait_for_log("touched a wall")
            self.wait_for_speed(0.0, self.truth)
            self.assertAlmostEqual(pose_of(self.truth[-1]).x, x, delta=1e-4)
            robot.set_motors(-0.5, -0.5)
            self.wait_for_speed(-0.3, self.odometry)
            self.wait_for_log("left wheel -0.30 m/s, right wheel -0.30 m/s")
        self.wait_for_speed(0.0, self.odometry)
        self.assertEqual(read(self.simulator).count("touched a wall"), 1)
        stamps = [message.header.stamp.to_nsec() for message in self.truth]
        self.assertEqual({(stamp - stamps[0]) % STEP for stamp in stamps}, {0})
        self.assertLess(abs(rospy.Time.now().to_nsec() - stamps[-1]), 1e9)
        self.assertEqual((self.truth[0].header.frame_id, self.truth[0].child_frame_id), ("map", "base_footprint"))

    def test_it_is_put_elsewhere_and_back_in_a_world_that_changes(self):
        place, world = self.publisher_of("set_pose", Pose2D), self.publisher_of("world", String)
        self.assertEqual(self.drawn, [[("walls", 4)]])
        world.publish(WORLD)
        self.wait_for(lambda: self.drawn[-1] == [("walls", 2), ("lines", 2)], 5.0, "a wall and a line")
        place.publish(0.5, -0.015, 0.0)
        self.wait_for(lambda: tuple(round(eye, 4) for eye in self.seen[-1].data) == (0, 0.75, 1), 5.0, "the line")
        self.assertEqual(self.seen[-1].layout.dim[0].label, "left, middle, right")
        place.publish(0.0, math.nan, 0.0)
        self.wait_for_log("A pose must be finite, and within 1000 m. The robot stays where it is.")
        world.publish("walls: [[[0, 0]]]")
        self.wait_for_log("The world that was sent cannot be used: polyline 1 of walls must be a list of two points")
        self.assertEqual((tuple(pose_of(self.truth[-1])), len(self.drawn)), ((0.5, -0.015, 0), 2))
        rospy.ServiceProxy("jetbot_simulator/reset", Empty)()
        self.wait_for(lambda: pose_of(self.odometry[-1]) == (1, 0.4, 0), 5.0, "the start")
        world.publish("")
        self.wait_for(lambda: self.drawn[-1] == [("walls", 4)], 5.0, "the world of the start")

    def test_its_camera_shows_the_world_while_somebody_subscribes(self):
        maps = Path(f"/proc/{self.simulator.pid}/maps")
        self.assertFalse("/PIL/" in maps.read_text(), "PIL is loaded before somebody subscribes")
        pictures, infos = (self.record(f"camera/{topic}", kind) for topic, kind in (
            ("image_raw/compressed", CompressedImage), ("camera_info", CameraInfo)))
        self.wait_for(lambda: len(pictures) > 5 and len(infos) > 5, START_TIMEOUT, "pictures")
        self.assertEqual({(each.format, each.header.frame_id, each.data) for each in pictures},
                         {("jpeg", "camera_optical", bgr8_to_jpeg(render(load("parking.yaml"), Pose(1.0, 0.4))))})
        self.assertEqual((infos[-1].width, infos[-1].K[0], infos[-1].K[2]), (224, focal_length(224), 111.5))

    def test_without_pil_it_logs_one_sentence_and_the_robot_drives_on(self):
        Path(self.folder, "PIL.py").write_text("raise ImportError('no PIL')")
        blind = self.start(program("simulation", "simulator.py"), "__ns:=blind", f"_i2c_bus:=fake:{self.bus}",
                           env={**os.environ, "PYTHONPATH": f"{self.folder}:{os.environ['PYTHONPATH']}"})
        self.record("/blind/camera/image_raw/compressed", CompressedImage)
        truth = self.record("/blind/jetbot_simulator/ground_truth", Odometry)
        sentence = "The simulated cameras show nothing: no PIL. Install: sudo apt install python3-numpy python3-pil"
        self.wait_for(lambda: sentence in read(blind), START_TIMEOUT, "the sentence")
        before = len(truth)
        self.wait_for(lambda: len(truth) > before + 5, 5.0, "the robot to be simulated")
