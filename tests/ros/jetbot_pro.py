#!/usr/bin/env python3
"""The JetBot Pro behind a pseudo-terminal: commands reach the board as frames, and its odometry reaches ROS."""

import contextlib
import os
import pty
import select
import signal
import struct
import threading
import time
import tty

import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu
from tf2_msgs.msg import TFMessage

from harness import CONTROLLER, START, RobotTest, main

STILL = (0, 0)


class Board:
    """The board's end of the wire: keeps the velocities it is sent, and reports a pose."""

    def __init__(self, link):
        self.received = []  # (monotonic seconds, (mm/s, mrad/s))
        self.bad = []
        self.plug_in(link)

    def plug_in(self, link):
        self._end, computer = pty.openpty()
        tty.setraw(self._end)
        os.symlink(os.ttyname(computer), link)
        self._link, self._computer, self._plugged = link, computer, True
        self._listener = threading.Thread(target=self._listen)
        self._listener.start()

    def unplug(self):
        with contextlib.suppress(FileNotFoundError):  # removed with the folder it was in
            os.unlink(self._link)
        self._plugged = False
        self._listener.join()
        os.close(self._computer)
        os.close(self._end)

    def report(self, x, y, yaw):
        body = b"\xaa\x55\x2d\x01" + struct.pack(">9h", 0, 0, 1000, 0, 0, 16384, 0, 0, 0)
        body += struct.pack(">3h", x, y, yaw) + bytes(16)
        os.write(self._end, body + bytes([sum(body) % 256]))

    def _listen(self):
        data = b""
        while self._plugged:
            if not select.select([self._end], [], [], 0.02)[0]:
                continue
            data += os.read(self._end, 4096)
            while len(data) > 2 and len(data) >= data[2]:
                self._take(data[:data[2]])
                data = data[data[2]:]

    def _take(self, frame):
        if frame[:2] != b"\xaa\x55" or sum(frame[:-1]) % 256 != frame[-1]:
            self.bad.append(frame)
        elif frame[3] == 0x11:
            vx, vy, wz = struct.unpack(">3h", frame[4:-1])
            self.received.append((time.monotonic(), (vx, wz)))

    @property
    def velocity(self):
        return self.received[-1][1] if self.received else None


class JetBotPro(RobotTest):
    def setUp(self):
        super().setUp()
        self.link = os.path.join(self.folder, "tty")
        self.board = Board(self.link)
        self.addCleanup(self.board.unplug)
        self.node = self.start(CONTROLLER, "_board:=jetbot_pro", f"_port:={self.link}", "_publish_tf:=true",
                               "_cmd_vel_timeout:=0.5")
        self.wait_for_controller()

    def wait_for_velocity(self, velocity, within=1.0):
        self.wait_for(lambda: self.board.velocity == velocity, within, f"{velocity}, not {self.board.velocity}")

    def test_every_command_arrives(self):
        for i in range(60):
            x, z = (i - 30) / 100, (17 * i % 60 - 30) / 100
            self.command(x, z)
            self.wait_for_velocity((round(1000 * x), round(1000 * z)))
        self.assertEqual(self.board.bad, [])

    def test_a_steady_command_is_repeated_twenty_times_a_second(self):
        self.publisher(0.5)
        self.wait_for_velocity((500, 0), within=START)
        count = len(self.board.received)
        self.wait_for(lambda: len(self.board.received) > count + 40, 2.0, "more than 20 frames a second")

    def test_stops_in_silence_and_at_the_end(self):
        self.command(0.5)
        self.wait_for_velocity((500, 0))
        self.wait_for_velocity(STILL, within=0.8)
        self.command(0.5)
        self.wait_for_velocity((500, 0))
        self.node.send_signal(signal.SIGINT)
        self.wait_for_velocity(STILL)

    def test_stops_when_the_controller_is_killed(self):
        self.command(0.5)
        self.wait_for_velocity((500, 0))
        os.killpg(self.node.pid, signal.SIGKILL)
        self.wait_for_velocity(STILL, within=1.5)

    def test_unplugged_and_plugged_in_again(self):
        texts = self.status()
        self.board.unplug()
        self.wait_for_status(texts, f"stopped: there is no serial port {self.link}, trying again")
        self.board.plug_in(self.link)
        self.publisher(0.3)
        self.wait_for_velocity((300, 0), within=START)
        self.wait_for_status(texts, "driving")

    def test_odometry_imu_and_tf(self):
        odoms, imus, transforms = [], [], []
        topics = (("odom", Odometry, odoms), ("imu/data_raw", Imu, imus), ("/tf", TFMessage, transforms))
        for topic, kind, heard in topics:
            self.addCleanup(rospy.Subscriber(topic, kind, heard.append).unregister)
        x = 0

        def all_heard():
            nonlocal x
            x += 10
            self.board.report(x, 0, 0)
            time.sleep(0.02)
            return len(odoms) > 20 and imus and transforms

        self.wait_for(all_heard, 5.0, "odometry, IMU and tf")
        odom = odoms[-1]
        self.assertEqual((odom.header.frame_id, odom.child_frame_id), ("odom", "base_footprint"))
        self.assertAlmostEqual(odom.pose.pose.position.x, x / 1000, delta=0.1)
        self.assertGreater(odom.twist.twist.linear.x, 0.1)
        self.assertGreater(odom.pose.covariance[0], odoms[0].pose.covariance[0])
        self.assertAlmostEqual(imus[-1].linear_acceleration.z, 9.80665)
        self.assertEqual(imus[-1].orientation_covariance[0], -1)
        self.assertEqual(transforms[-1].transforms[0].child_frame_id, "base_footprint")


if __name__ == "__main__":
    main(JetBotPro)
