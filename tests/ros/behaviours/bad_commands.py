"""A command that is not finite stops the robot, a huge one is clamped, another type ignored; the node keeps running."""

import math

from harness import RobotTest


class BadCommands(RobotTest):
    def test_not_finite(self):
        self.controller()
        texts = self.status()
        for bad in ((math.nan, 0.0), (0.5, -math.inf)):
            self.drive_at(0.5)
            self.command(*bad)
            self.wait_for_stop(within=0.2)
            self.wait_for_status(texts, "stopped: command was not finite")

    def test_huge(self):
        self.controller()
        self.command(1e308, 1e308)
        self.wait_for_wheels(0.0, 1.0)

    def test_wrong_type(self):
        node = self.controller()
        self.start("rostopic", "pub", "-r", "10", "/cmd_vel", "std_msgs/Float64", "1.0")
        self.wheels_stay(0, 0, for_seconds=2)
        self.assertIsNone(node.poll())
        self.drive_at(0.5)
