"""Frozen programs that only listen keep no stop, no release and no new commander from a robot."""

import os
import signal

import rospy
from std_msgs.msg import Bool

from harness import START_TIMEOUT, RobotTest, end, near, program, publishers, read

STOP = program("jetbot_tools", "emergency_stop.py")
FROZEN = 4  # the master announces publishers from three threads, which wait for them
HEAL_TIMEOUT = 10.0  # s; a second, on a quiet computer


class Bystanders(RobotTest):
    def setUp(self):
        super().setUp()
        self.controller()
        self.driver = self.publisher()
        self.wait_for_wheels(0.5, 0.5, START_TIMEOUT)
        listeners = [self.start("rostopic", "echo", "/cmd_vel") for _ in range(FROZEN)]
        for listener in listeners:
            self.wait_for(lambda: "linear" in read(listener), START_TIMEOUT, "it to listen")  # noqa: B023
            os.killpg(listener.pid, signal.SIGSTOP)
        before = len(publishers("/cmd_vel"))
        self.start("rostopic", "pub", "/cmd_vel", "geometry_msgs/Twist", "{}")
        self.wait_for(lambda: len(publishers("/cmd_vel")) > before, START_TIMEOUT, "a publisher to announce")

    def test_a_stop_a_release_and_a_new_commander_arrive(self):
        stop = self.start(STOP)
        self.wait_for_stop(START_TIMEOUT)
        self.assertEqual(stop.wait(START_TIMEOUT), 0, read(stop))
        release = self.start(STOP, "--release")
        self.wait_for_wheels(0.5, 0.5, START_TIMEOUT)
        self.assertEqual(release.wait(START_TIMEOUT), 0, read(release))
        end([self.driver])
        self.wait_for_stop(1.0)
        self.publisher()
        self.wait_for_wheels(0.5, 0.5, START_TIMEOUT)
        latched = rospy.Publisher("/emergency_stop", Bool, queue_size=1, latch=True)  # by a program of a user's own
        self.addCleanup(latched.unregister)
        latched.publish(True)
        self.wait_for_stop(HEAL_TIMEOUT)

    def test_a_link_that_breaks_off_is_made_again(self):
        statuses = self.status()
        self.wait_for(lambda: self.command(0.25) or any("3 programs" in text for text in statuses), HEAL_TIMEOUT,
                      "all to command")
        end([self.driver])
        for connection in self.commands().impl.connections:
            connection.close()
        self.wait_for(lambda: self.command(0.25) or near(self.wheels(), (0.25, 0.25)), HEAL_TIMEOUT,
                      "the robot to obey")
