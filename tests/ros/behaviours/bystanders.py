"""Frozen programs that only listen keep no stop, no release and no new commander from a robot."""

import os
import signal

import rospy
from std_msgs.msg import Bool

from harness import START_TIMEOUT, RobotTest, end, near, program, read

STOP = program("jetbot_tools", "emergency_stop.py")
FROZEN = 4  # the master announces publishers from three threads
HEAL_TIMEOUT = 10.0  # s; a second, on a quiet computer


class Bystanders(RobotTest):
    def setUp(self):
        super().setUp()
        self.controller()
        self.driver = self.publisher()
        self.wait_for_wheels(0.5, 0.5, START_TIMEOUT)
        for topic in ["/cmd_vel", "/emergency_stop"] * (FROZEN // 2):
            listener = self.start("rostopic", "echo", topic)
            self.wait_for(lambda: self.listeners() >= len(self.processes), START_TIMEOUT, "it to listen")
            os.killpg(listener.pid, signal.SIGSTOP)

    def listeners(self):
        """Return how many nodes subscribe to commands and stops: the controller to both, others to one."""
        _, subscribers, _ = rospy.get_master().getSystemState()[2]
        return sum(len(nodes) for topic, nodes in subscribers if topic in ("/cmd_vel", "/emergency_stop"))

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
        self.wait_for(lambda: statuses, HEAL_TIMEOUT, "a status")
        self.command(0.25)
        self.wait_for(lambda: any("2 programs" in text for text in statuses), HEAL_TIMEOUT, "both to command")
        end([self.driver])
        for connection in self.commands().impl.connections:
            connection.close()
        self.wait_for(lambda: self.command(0.25) or near(self.wheels(), (0.25, 0.25)), HEAL_TIMEOUT,
                      "the robot to obey")
