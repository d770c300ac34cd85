"""The JetBot Pro behind a pseudo-terminal: commands reach the board as frames, and its odometry reaches ROS."""

import contextlib
import os
import pty
import select
import signal
import threading
import tty

import rospy
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu
from std_msgs.msg import Float32MultiArray
from tf2_msgs.msg import TFMessage

from harness import CONTROLLER, START_TIMEOUT, SharedRobotTest
from jetbot.fake.chips import JetBotPro

STOPPED = (0, 0)  # mm/s, mrad/s


class Board(JetBotPro):
    """A simulated board at one end of a pseudo-terminal, whose other end a symbolic link names."""

    def __init__(self, link):
        super().__init__()
        self._link = link
        self.plug_in()

    def plug_in(self):
        self._end, self._host = pty.openpty()
        tty.setraw(self._end)
        os.symlink(os.ttyname(self._host), self._link)
        self._plugged = True
        self._listener = threading.Thread(target=self._listen)
        self._listener.start()

    def unplug(self):
        with contextlib.suppress(FileNotFoundError):  # removed with its folder
            os.unlink(self._link)
        self._plugged = False
        self._listener.join()
        os.close(self._host)
        os.close(self._end)

    def send_telemetry(self, x, y, yaw):
        os.write(self._end, self.telemetry(x, y, yaw))

    def _listen(self):
        while self._plugged:
            if select.select([self._end], [], [], 0.02)[0]:
                self.receive(os.read(self._end, 4096))

    @property
    def velocity(self):
        """Return the last velocity received, (mm/s, mrad/s), None before the first."""
        return self.velocities[-1] if self.velocities else None


class JetBotProTest(SharedRobotTest):
    hardware = ""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.link = os.path.join(cls.shared.folder, "tty")
        cls.board = Board(cls.link)
        cls.addClassCleanup(cls.board.unplug)
        cls.start_controller()

    @classmethod
    def start_controller(cls):
        cls.node = cls.shared.start(CONTROLLER, "_board:=jetbot_pro", f"_port:={cls.link}", "_publish_tf:=true",
                                    "_cmd_vel_timeout:=0.5")

    def setUp(self):
        super().setUp()
        if self.node.poll() is not None:
            self.start_controller()
        self.wait_for_controller()

    def wait_for_velocity(self, velocity, within=1.0):
        self.wait_for(lambda: self.board.velocity == velocity, within, f"{velocity}, not {self.board.velocity}")

    def drive_at(self, speed):
        self.command(speed)
        self.wait_for_velocity((1000 * speed, 0))

    def test_every_command_arrives(self):
        for i in range(0, 60, 3):
            x, z = 50 * (i - 30), 70 * (17 * i % 60 - 30)  # mm/s, mrad/s; the board, not the node, limits its wheels
            self.command(x / 1000, z / 1000)
            self.wait_for_velocity((x, z))
        self.assertFalse(self.board.bad)

    def test_its_wheels_are_reported_as_fractions_of_full_power(self):
        wheels = self.record("/jetbot_controller/wheels", Float32MultiArray,
                             lambda message: [round(value, 2) for value in message.data])
        expected = [0.3, 1.6, 0.35, 0.65]  # m/s, rad/s: the left wheel gets 0.3 - 1.6 * 0.1125 / 2 of 0.6 m/s
        self.wait_for(lambda: self.command(*expected[:2]) or expected in wheels, START_TIMEOUT, f"{expected}")

    def test_stops_at_the_timeout_and_at_shutdown(self):
        self.drive_at(0.5)
        self.wait_for_velocity(STOPPED, within=0.8)
        self.drive_at(0.5)
        self.node.send_signal(signal.SIGINT)
        self.wait_for_velocity(STOPPED)
        self.node.wait(START_TIMEOUT)

    def test_stops_when_the_controller_is_killed(self):
        self.drive_at(0.5)
        os.killpg(self.node.pid, signal.SIGKILL)
        self.wait_for_velocity(STOPPED, within=1.5)
        self.node.wait(START_TIMEOUT)

    def test_unplugged_and_plugged_in_again(self):
        texts = self.status()
        self.wait_for(lambda: texts, START_TIMEOUT, "the first status")
        self.board.unplug()
        self.wait_for_status(texts, f"stopped: there is no serial port {self.link}, trying again")
        self.board.plug_in()
        self.publisher()
        self.wait_for_velocity((500, 0), within=START_TIMEOUT)
        self.wait_for_status(texts, "driving")

    def test_its_computer_is_read_as_no_port_is_fake(self):
        arrays = self.record("/diagnostics", DiagnosticArray)
        self.wait_for(lambda: arrays and "megabytes" in [pair.key for pair in arrays[-1].status[1].values],
                      START_TIMEOUT, "the free space of its disk in /diagnostics")

    def test_odometry_imu_and_tf(self):
        odoms, imus = self.record("odom", Odometry), self.record("imu/data_raw", Imu)
        transforms = self.record("/tf", TFMessage)
        for x in range(0, 10000, 10):  # mm
            self.board.send_telemetry(x, 0, 0)
            rospy.sleep(0.02)
            if len(odoms) > 20 and imus and transforms:
                break
        odom = odoms[-1]
        self.assertEqual((odom.header.frame_id, odom.child_frame_id), ("odom", "base_footprint"))
        self.assertAlmostEqual(odom.pose.pose.position.x, x / 1000, delta=0.1)
        self.assertGreater(odom.twist.twist.linear.x, 0.1)
        self.assertGreater(odom.pose.covariance[0], odoms[0].pose.covariance[0])
        self.assertAlmostEqual(imus[-1].linear_acceleration.z, 9.80665)
        self.assertEqual(imus[-1].orientation_covariance[0], -1)
        self.assertEqual(transforms[-1].transforms[0].child_frame_id, "base_footprint")
