#!/usr/bin/env python3
"""Two robots on one master: each obeys its own cmd_vel on its own fake bus, and one emergency stop stops both."""

import os
from pathlib import Path

import rospy
from geometry_msgs.msg import Twist

from harness import CONTROLLER, START_TIMEOUT, STOPPED, RobotTest, main, near, twist, wheel_speeds

SPEEDS = {"red": (0.25, 0.25), "blue": (0.75, 0.75)}  # of each robot's wheels


class Namespaces(RobotTest):
    def test_two_robots(self):
        home = Path(self.folder, "home")
        for name, (speed, _) in SPEEDS.items():
            self.start(CONTROLLER, "_i2c_bus:=fake", "_cmd_vel_timeout:=0",
                       env={**os.environ, "ROS_NAMESPACE": name, "ROS_HOME": str(home)})
            rospy.Publisher(f"/{name}/cmd_vel", Twist, queue_size=1, latch=True).publish(twist(speed))

        def all_at(wanted):
            return all(near(wheel_speeds(home / "fake_i2c" / name), wanted[name]) for name in SPEEDS)

        self.wait_for(lambda: all_at(SPEEDS), START_TIMEOUT, "both to drive at their own speeds")
        self.emergency_stop(True)
        self.wait_for(lambda: all_at(dict.fromkeys(SPEEDS, STOPPED)), 1.0, "both to stop")
        self.wait_for(lambda: all(f"{name}: stopped: emergency stop" in self.logs() for name in SPEEDS), START_TIMEOUT,
                      "both to log their names")


if __name__ == "__main__":
    main(Namespaces)
