#!/usr/bin/env python3
"""The motion node publishes x 0.5 and z 0.1 ten times a second, and rejects a parameter that it cannot use."""

import time

import rospy
from geometry_msgs.msg import Twist

from harness import START_TIMEOUT, RobotTest, main, program, read

MOTION = program("workshop", "jetbot_motion_control.py")


class MotionRate(RobotTest):
    def test_rate_and_values(self):
        self.start(MOTION)
        received = []
        rospy.Subscriber("/cmd_vel", Twist, lambda twist: received.append((time.monotonic(), twist)))
        self.wait_for(lambda: len(received) > 30, START_TIMEOUT, "31 commands")
        (first, _), (last, _) = received[0], received[30]
        self.assertAlmostEqual(30 / (last - first), 10, delta=0.5)
        self.assertEqual({(twist.linear.x, twist.angular.z) for _, twist in received}, {(0.5, 0.1)})

    def test_bad_parameter(self):
        node = self.start(MOTION, "_rate:=0")
        self.assertNotEqual(node.wait(START_TIMEOUT), 0)
        [line] = read(node).splitlines()
        self.assertIn("The parameter rate must be a number above 0, not 0.", line)


if __name__ == "__main__":
    main(MotionRate)
