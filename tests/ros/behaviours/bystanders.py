"""Frozen programs that only listen keep no stop, no release and no new commander from a robot."""

import os
import signal
import socket

import rosgraph
import rospy
from diagnostic_msgs.msg import KeyValue
from geometry_msgs.msg import Twist
from std_msgs.msg import Bool

from harness import START_TIMEOUT, SharedRobotTest, end, near, program, publishers, read
from jetbot_ros.master import system_state
from web_client import open_page

STOP = program("jetbot_tools", "emergency_stop.py")
FROZEN = 4  # the master announces publishers from three threads, which wait for them
HEAL_TIMEOUT = 10.0  # s; a second, on a quiet computer


class Bystanders(SharedRobotTest):
    @classmethod
    def setUpClass(cls):
        """Let a robot be driven while a program that listens is frozen, and others that the master takes for such."""
        super().setUpClass()
        shared = cls.shared
        shared.controller()
        cls.driver = shared.publisher()
        shared.wait_for_wheels(0.5, 0.5, START_TIMEOUT)
        listener = shared.start("rostopic", "echo", "/cmd_vel")
        shared.wait_for(lambda: "linear" in read(listener), START_TIMEOUT, "it to listen")
        os.killpg(listener.pid, signal.SIGSTOP)
        for number in range(1, FROZEN):
            silent = socket.create_server(("localhost", 0))
            cls.addClassCleanup(silent.close)
            rosgraph.Master(f"/frozen{number}").registerSubscriber(
                "/cmd_vel", Twist._type, f"http://localhost:{silent.getsockname()[1]}/")
        before = len(publishers("/cmd_vel"))
        shared.start("rostopic", "pub", "/cmd_vel", "geometry_msgs/Twist", "{}")
        shared.wait_for(lambda: len(publishers("/cmd_vel")) > before, START_TIMEOUT, "a publisher to announce")

    def setUp(self):
        super().setUp()
        self.wait_for_wheels(0.5, 0.5, START_TIMEOUT)

    def drive_again(self):
        """Replace the program that drives, if it has ended."""
        if self.driver.poll() is not None:
            type(self).driver = self.shared.publisher()
        self.wait_for_wheels(0.5, 0.5, START_TIMEOUT)

    def test_a_stop_a_release_and_a_new_commander_arrive(self):
        stop = self.start(STOP)
        self.wait_for_stop(START_TIMEOUT)
        self.assertEqual(stop.wait(START_TIMEOUT), 0, read(stop))
        release = self.start(STOP, "--release")
        self.wait_for_wheels(0.5, 0.5, START_TIMEOUT)
        self.assertEqual(release.wait(START_TIMEOUT), 0, read(release))
        end([self.driver])
        self.wait_for_stop(1.0)
        self.drive_again()
        latched = rospy.Publisher("/emergency_stop", Bool, queue_size=1, latch=True)  # by a program of a user's own
        self.addCleanup(latched.unregister)
        latched.publish(True)
        self.wait_for_stop(HEAL_TIMEOUT)
        latched.publish(False)
        self.drive_again()

    def test_a_stop_on_the_page_of_a_cockpit_that_starts_then_arrives(self):
        heard = self.record("/emergency_stop", Bool, lambda message: message.data)  # by a node that heals no link
        page = open_page(self.cockpit()[1])
        page.receive_until(lambda message: "/" in message.get("robots", ()))
        page.send({"type": "stop"})
        self.wait_for_stop(START_TIMEOUT)
        self.wait_for(lambda: True in heard, START_TIMEOUT, "the cockpit to tell each listener itself")
        page.send({"type": "release"})
        self.wait_for(lambda: heard[-1] is False, START_TIMEOUT, "the release")
        page.send({"type": "go_on", "robot": "/"})
        self.wait_for_wheels(0.5, 0.5, START_TIMEOUT)

    def test_a_page_that_comes_then_is_heard_by_the_judge(self):
        self.start(program("driving_tasks", "class_judge.py"))
        self.wait_for(lambda: system_state()[1].get("/judge_requests"), START_TIMEOUT, "the judge")
        requests = rospy.Publisher("/judge_requests", KeyValue, queue_size=1)
        self.addCleanup(requests.unregister)
        self.wait_for(requests.get_num_connections, HEAL_TIMEOUT, "the judge to connect")

    def test_a_link_that_breaks_off_is_made_again(self):
        statuses = self.status()
        self.wait_for(lambda: self.command(0.25) or any("3 programs" in text for text in statuses), HEAL_TIMEOUT,
                      "all to command")
        end([self.driver])
        for connection in self.commands().impl.connections:
            connection.close()
        self.wait_for(lambda: self.command(0.25) or near(self.wheels(), (0.25, 0.25)), HEAL_TIMEOUT,
                      "the robot to obey")
        self.commands().unregister()
        self.drive_again()
