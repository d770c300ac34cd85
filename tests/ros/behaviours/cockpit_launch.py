"""The cockpit beside a robot, as ./morbot run starts it, and with a class: one page, which no robot needs to drive."""

import json
import os
import signal
import subprocess
import sys
import urllib.request
from pathlib import Path

import rospy
from geometry_msgs.msg import Pose2D
from nav_msgs.msg import Odometry
from std_msgs.msg import String
from std_srvs.srv import Empty

from driving_tasks.sources.judged_robot import simulated_robots
from harness import START_TIMEOUT, RobotTest, find_processes, free_port, pid, read
from jetbot_cockpit.remote import identity
from jetbot_cockpit.remote.identity import Identity
from jetbot_cockpit.remote.key import robot_key
from jetbot_ros.ros_messages import pose_of

RUN = Path(__file__).parents[3] / "setup/run.py"  # ./morbot run
KEY = robot_key("A" * 26, "jetbot_07")
CLASS = ("/jetbot_01", "/jetbot_02")
BROWSER = '#!/bin/sh\necho "$@" >>{}\n'


class CockpitLaunch(RobotTest):
    def setUp(self):
        super().setUp()
        self.port = free_port()
        self.environment = {**os.environ, "ROS_HOME": os.path.join(self.folder, "home")}

    def address(self):
        return f"http://localhost:{self.port}/"

    def is_served(self):
        """Return whether this computer's browser gets the page."""
        try:
            with urllib.request.urlopen(self.address(), timeout=10) as answer:
                return b'id="pad"' in answer.read()
        except OSError:
            return False

    def open_ports(self, local=False):
        """Return the ports at which other computers reach this test's nodes. local: those of this computer alone."""
        nodes = [f"pid={process}," for process in find_processes(self.folder)]
        rows = [row.split() for row in subprocess.check_output(["ss", "-Hltnp"], text=True).splitlines()]
        return {int(row[3].rpartition(":")[2]) for row in rows if any(node in row[-1] for node in nodes)
                and row[3].startswith(("127.", "[::1]", "[::ffff:127.")) is local}

    def test_run_prints_the_address_of_the_page_opens_it_where_there_is_a_desktop_and_drives_on_without_it(self):
        opened = Path(self.folder, "opened")
        browser = Path(self.folder, "xdg-open")
        browser.write_text(BROWSER.format(opened))
        browser.chmod(0o755)
        environment = {**self.environment, "DISPLAY": ":99", "PATH": f"{self.folder}:{os.environ['PATH']}"}
        environment.pop("SSH_CONNECTION", None)
        run = self.start(sys.executable, str(RUN), "a robot", "simulation", "simulation.launch", "motion:=true",
                         "cockpit:=true", "browser:=auto", "rviz:=false", f"i2c_bus:=fake:{self.bus}",
                         f"cockpit_port:={self.port}", env=environment)
        self.wait_for(self.is_served, START_TIMEOUT, "the page")
        self.wait_for(lambda: opened.exists() and opened.read_text(), START_TIMEOUT, "the browser")
        self.assertEqual(opened.read_text().split(), [self.address()])
        self.wait_for(lambda: f" {self.address()}\n" in read(run), START_TIMEOUT, "the address")
        self.wait_for_wheels(0.4, 0.6, START_TIMEOUT)
        os.kill(pid("/jetbot_cockpit"), signal.SIGKILL)
        self.wait_for(lambda: "process has died" in read(run), START_TIMEOUT, "the cockpit's end")
        self.assertFalse(self.is_served())
        self.wheels_stay(0.4, 0.6, for_seconds=1.0)

    def test_a_class_has_a_code_for_each_robot_and_goes_on_without_one(self):
        statuses = {name: self.record(f"{name}/jetbot_controller/status", String) for name in CLASS}
        poses = {name: self.record(f"{name}/jetbot_simulator/ground_truth", Odometry, pose_of) for name in CLASS}
        launch = self.start("roslaunch", "jetbot_class", "class.launch", "robots:=2", "lan:=true",
                            f"port:={self.port}", "class:=7", f"classes:={self.folder}", env=self.environment)
        self.wait_for(self.is_served, START_TIMEOUT, "the page")
        self.wait_for(lambda: all(statuses.values()), START_TIMEOUT, "both robots")
        self.wait_for(lambda: read(launch).endswith(f" {self.address()}\n"), 10.0, "its address, last of all")
        codes = json.loads(Path(self.folder, "7/codes.json").read_text())
        self.assertEqual({*codes}, {"teacher", *(name[1:] for name in CLASS)}, "kept")
        started, _, printed = read(launch).rpartition("on the page: jetbot_01 and jetbot_02\n")
        self.assertTrue(started and all(code in printed for code, _ in codes.values()), printed)
        self.assertEqual(self.open_ports(), {self.port})
        self.wait_for(lambda: all(poses.values()), START_TIMEOUT, "the simulator")
        os.kill(pid(f"{CLASS[0]}/jetbot_controller"), signal.SIGKILL)
        self.wait_for(lambda: read(launch).count("process has died") == 1, START_TIMEOUT, "roslaunch to see it")
        self.assertIsNone(launch.poll())
        self.assertTrue(self.is_served() and pid(f"{CLASS[1]}/jetbot_controller"))
        self.assert_one_simulator_has_all_and_is_started_again(poses)

    def test_other_computers_reach_the_page_of_a_classs_robot_and_nothing_else(self):
        master = free_port()
        identity.write(Identity("jetbot_07", "7b", KEY), f"{self.environment['ROS_HOME']}/morbot_robot.json")
        environment = {**self.environment, "ROS_MASTER_URI": f"http://localhost:{master}"}
        launch = self.start("roslaunch", "-p", str(master), "jetbot_class", "robot.launch", "robot:=jetbot_07",
                            "camera:=false", f"i2c_bus:=fake:{self.bus}", f"cockpit_port:={self.port}",
                            env=environment)
        self.wait_for(lambda: "on the page: jetbot_07" in read(launch), START_TIMEOUT, "the page")
        self.assertEqual(self.open_ports(), {self.port})
        self.assertIn(master, self.open_ports(local=True))

    def assert_one_simulator_has_all_and_is_started_again(self, poses):
        """Fail unless robots are apart, one of them is put elsewhere and back, and all return after a SIGKILL."""
        self.assertEqual(simulated_robots(), [*CLASS], "as the judge finds them")
        starts = [rospy.get_param(f"{name}/jetbot_simulator/x") for name in CLASS]
        self.assertEqual([messages[-1].x for messages in poses.values()], starts)
        place = rospy.Publisher(f"{CLASS[1]}/jetbot_simulator/set_pose", Pose2D, queue_size=1, latch=True)
        place.publish(1.0, 1.0, 0.5)
        self.wait_for(lambda: poses[CLASS[1]][-1] == (1, 1, 0.5), 5.0, "one robot elsewhere")
        self.assertEqual(poses[CLASS[0]][-1], (starts[0], 0, 0))
        place.unregister()
        rospy.ServiceProxy(f"{CLASS[1]}/jetbot_simulator/reset", Empty)()
        self.wait_for(lambda: poses[CLASS[1]][-1].x == starts[1], 5.0, "its start")
        os.kill(pid("/class_simulator"), signal.SIGKILL)
        self.wait_for(lambda: pid("/class_simulator") is None, START_TIMEOUT, "its end")
        for messages in poses.values():
            messages.clear()
        self.wait_for(lambda: all(poses.values()), START_TIMEOUT, "the next simulator")
