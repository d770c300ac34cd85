#!/usr/bin/env python3
"""Checks what the image promises, from inside: docker/build runs this in it. Needs nothing that the image lacks."""

import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time
import unittest
import urllib.request
from pathlib import Path

from jetbot.camera.sources import find_command
from jetbot.fake.motors import STOPPED, wheel_speeds
from jetbot.wait import wait_until

START_TIMEOUT = 30.0  # s, until ROS works; generous, for slow machines
LISTEN = "0A"         # state of a socket in /proc/net/tcp
LOOPBACK = ("0100007F", "00000000000000000000000001000000")  # as /proc/net/tcp and tcp6 write 127.0.0.1 and ::1


class Image(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.bus = Path(folder.name, "bus")
        self.environment = {**os.environ, "ROS_MASTER_URI": f"http://localhost:{free_port()}"}

    @unittest.skipIf(os.path.exists("/opt/ros/noetic"), "Noetic's own image holds one")
    def test_has_no_compiler(self):
        self.assertFalse([name for name in ("cc", "gcc", "g++", "c++", "make", "cmake") if shutil.which(name)])

    def test_runs_as_a_normal_user(self):
        status = Path("/proc/self/status").read_text()
        self.assertNotEqual(os.getuid(), 0)
        self.assertIn("CapEff:\t0000000000000000\n", status)

    def test_is_healthy_while_the_controller_answers_that_reads_the_settings_shipped(self):
        self.assertFalse(self.is_healthy())
        launch = self.launch("jetbot_control_node", "jetbot_controller.launch", "config:=si_units.yaml",
                             ROS_NAMESPACE="red")
        self.wait_for(self.is_healthy)
        controller = descendants(launch.pid, "jetbot_controller.py")[0]
        os.kill(controller, signal.SIGSTOP)
        self.assertFalse(self.is_healthy())
        os.kill(controller, signal.SIGCONT)
        self.wait_for(self.is_healthy)

    def test_stops_the_wheels_when_it_is_asked_to_end(self):
        launch = self.launch("workshop", "workshop_jetbot_controller.launch")
        self.wait_for(self.drives)
        start = time.monotonic()
        launch.terminate()
        self.wait_for(lambda: not self.drives())
        stopped = time.monotonic() - start
        launch.wait(START_TIMEOUT)
        print(f"wheels stopped after {stopped:.2f} s, processes ended after {time.monotonic() - start:.2f} s", end=" ")

    def test_serves_the_cockpits_page_to_this_computer_alone(self):
        port = free_port()
        launch = self.launch("jetbot_control_node", "jetbot_controller.launch", "cockpit:=true",
                             f"cockpit_port:={port}")
        self.wait_for(lambda: b'id="pad"' in page(port))
        addresses = listening([launch.pid, *descendants(launch.pid)])
        self.assertTrue(addresses)
        self.assertLessEqual(set(addresses), set(LOOPBACK))

    def test_has_all_that_a_usb_camera_needs(self):
        line = find_command("/dev/video0").line
        self.assertEqual(subprocess.run(["gst-inspect-1.0", "--exists", "v4l2src"]).returncode, 0)
        picture = line.replace("v4l2src device=/dev/video0", "videotestsrc num-buffers=9")
        self.assertNotEqual(picture, line)
        made = subprocess.run(["sh", "-c", picture], stdout=subprocess.PIPE, timeout=START_TIMEOUT)
        self.assertTrue(made.stdout.startswith(b"\xff\xd8") and made.stdout.endswith(b"\xff\xd9"))

    def launch(self, package, file, *arguments, **environment):
        """Start roslaunch on a fake bus by the image's entrypoint."""
        process = subprocess.Popen(["/entrypoint", "roslaunch", package, file, f"i2c_bus:=fake:{self.bus}", *arguments],
                                   env={**self.environment, **environment}, stdout=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        self.addCleanup(process.terminate)
        return process

    def is_healthy(self):
        check = subprocess.run(["/entrypoint", "/healthcheck"], env=self.environment, stderr=subprocess.DEVNULL)
        return check.returncode == 0

    def drives(self):
        return wheel_speeds(self.bus) != STOPPED

    def wait_for(self, condition):
        self.assertTrue(wait_until(condition, START_TIMEOUT), f"waited {START_TIMEOUT} s")


def free_port():
    """Return a TCP port of this computer that no program uses."""
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


def page(port):
    """Return the page on this port of this computer, b"" while there is none."""
    try:
        with urllib.request.urlopen(f"http://localhost:{port}/", timeout=START_TIMEOUT) as answer:
            return answer.read()
    except OSError:
        return b""


def descendants(pid, program=""):
    """Return the ids of the processes below this one whose command line contains the program's name."""
    children = [int(child) for threads in Path(f"/proc/{pid}/task").glob("*/children")
                for child in threads.read_text().split()]
    below = children + [each for child in children for each in descendants(child)]
    return [each for each in below if program in Path(f"/proc/{each}/cmdline").read_text()]


def listening(processes):
    """Return the addresses on which these processes listen, in hexadecimal."""
    sockets = {os.readlink(file) for pid in processes for file in Path(f"/proc/{pid}/fd").iterdir()}
    rows = [row.split() for table in ("tcp", "tcp6") for row in Path(f"/proc/net/{table}").read_text().splitlines()[1:]]
    return [row[1].split(":")[0] for row in rows if row[3] == LISTEN and f"socket:[{row[9]}]" in sockets]


if __name__ == "__main__":
    unittest.main(verbosity=2)
