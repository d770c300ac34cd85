#!/usr/bin/env python3
"""Two robots under one master: each obeys its own cmd_vel on its own fake bus, and one emergency stop stops both."""

import os
from pathlib import Path

import rospy
from geometry_msgs.msg import Twist

from harness import CONTROLLER, START, STILL, RobotTest, main, near, twist, wheel_speeds


class Namespaces(RobotTest):
    def test_two_robots(self):
        home = Path(self.folder, "home")
        speeds = {"red": 0.25, "blue": 0.75}
        for name, speed in speeds.items():
            self.start(CONTROLLER, "_i2c_bus:=fake", "_cmd_vel_timeout:=0",
                       env={**os.environ, "ROS_NAMESPACE": name, "ROS_HOME": str(home)})
            publisher = rospy.Publisher(f"/{name}/cmd_vel", Twist, queue_size=1, latch=True)
            publisher.publish(twist(speed))

        def driving(name):
            return near(wheel_speeds(home / "fake_i2c" / name), (speeds[name], speeds[name]))

        def still(name):
            return wheel_speeds(home / "fake_i2c" / name) == STILL

        self.wait_for(lambda: all(map(driving, speeds)), START, "both to drive at their own speeds")
        self.emergency_stop(True)
        self.wait_for(lambda: all(map(still, speeds)), 1.0, "both to stop")
        self.wait_for(lambda: all(f"{name}: stopped: emergency stop" in self.logs() for name in speeds), START,
                      "both to tell which one they are")


if __name__ == "__main__":
    main(Namespaces)
