#!/usr/bin/env python3
"""The motion node publishes x 0.5 and z 0.1, ten times a second."""

import time

import rospy
from geometry_msgs.msg import Twist

from harness import START, RobotTest, main, program


class MotionRate(RobotTest):
    def test_rate_and_values(self):
        self.start(program("workshop", "jetbot_motion_control.py"))
        received = []
        rospy.Subscriber("/cmd_vel", Twist, lambda twist: received.append((time.monotonic(), twist)))
        self.wait_for(lambda: len(received) > 30, START, "31 commands")
        (first, _), (last, _) = received[0], received[30]
        self.assertAlmostEqual(30 / (last - first), 10, delta=0.5)
        self.assertEqual({(twist.linear.x, twist.angular.z) for _, twist in received}, {(0.5, 0.1)})


if __name__ == "__main__":
    main(MotionRate)
