"""Many robots on one master: each obeys its own commands, one emergency stop stops all, one that dies ends alone."""

import os
import signal
from pathlib import Path

import rospy
from geometry_msgs.msg import Twist
from roslaunch.config import ROSLaunchConfig
from roslaunch.xmlloader import XmlLoader
from rospkg import RosPack

from harness import RobotTest, near, pid, twist, wheel_speeds

LAUNCH, CLASS = (RosPack().get_path(package) + f"/launch/{name}.launch"
                 for package, name in (("jetbot_control_node", "many_robots"), ("jetbot_class", "class")))
ROBOTS = 5  # bench measures 30
START_TIMEOUT = 60.0  # s, until all work; roslaunch starts one after the other
KILLED = "jetbot_03"


class ManyRobots(RobotTest):
    def setUp(self):
        super().setUp()
        self.home = Path(self.folder, "home")
        self.speeds = {f"jetbot_{i:02}": i / 100 for i in range(1, ROBOTS + 1)}
        self.publishers = {name: rospy.Publisher(f"/{name}/cmd_vel", Twist, queue_size=1) for name in self.speeds}

    def command_all(self, _):
        for name, speed in self.speeds.items():
            self.publishers[name].publish(twist(speed))

    def test_how_many_robots(self):
        for file, robots in (LAUNCH, "1.5"), (LAUNCH, "100"), (CLASS, "100"), (CLASS, "-1"):
            with self.assertRaisesRegex(SystemExit, "^morbot: robots:= is a whole number from 1 to 99$"):
                XmlLoader().load(file, ROSLaunchConfig(), argv=[f"robots:={robots}"], verbose=False)

    def are_at(self, speeds):
        return all(near(wheel_speeds(self.home / "fake_i2c" / name), (speed, speed)) for name, speed in speeds.items())

    def test_five_robots(self):
        self.start("roslaunch", LAUNCH, f"robots:={ROBOTS}",
                   env={**os.environ, "ROS_HOME": str(self.home)})
        self.emergency_stop(False)
        self.wait_for(lambda: all(each.get_num_connections() for each in self.publishers.values())
                      and self._emergency.get_num_connections() == ROBOTS, START_TIMEOUT, "all to subscribe")
        self.addCleanup(rospy.Timer(rospy.Duration(0.1), self.command_all).shutdown)
        self.wait_for(lambda: self.are_at(self.speeds), 5.0, "each to drive at its own speed")
        self.emergency_stop(True)
        self.wait_for(lambda: self.are_at(dict.fromkeys(self.speeds, 0)), 0.5, "all to stop")
        self.wait_for(lambda: all(f"{name}: stopped: emergency stop" in self.logs() for name in self.speeds), 5.0,
                      "all to log their names")
        os.kill(pid(f"/{KILLED}/jetbot_controller"), signal.SIGKILL)
        others = {name: speed for name, speed in self.speeds.items() if name != KILLED}
        self.emergency_stop(False)
        self.wait_for(lambda: self.are_at(others), 5.0, "all others to drive")
