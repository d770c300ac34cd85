"""A latched command is a standing order: it holds until its program ends, freezes or is cut off, or another comes."""

import os
import signal
import socket

import rosgraph
import rospy
from geometry_msgs.msg import Twist

from harness import START_TIMEOUT, RobotTest, publishers, twist

STOP_TIMEOUT = 1.2  # s, from the end of its program to the stop


class StandingOrder(RobotTest):
    def order(self):
        """Start the workshop's own command, typed without -r."""
        return self.start("rostopic", "pub", "/cmd_vel", "geometry_msgs/Twist", "{linear: {x: 0.5}}")

    def driven_by_an_order(self, **parameters):
        """Return the process that has ordered a controller to drive."""
        self.controller(**parameters)
        self.texts = self.status()
        order = self.order()
        self.wait_for_wheels(0.5, 0.5, within=START_TIMEOUT)
        return order

    def test_holds_until_its_program_is_frozen(self):
        order = self.driven_by_an_order()
        self.wheels_stay(0.5, 0.5, for_seconds=1.5)
        os.killpg(order.pid, signal.SIGSTOP)
        self.wait_for_stop(within=STOP_TIMEOUT)
        self.wait_for(lambda: "does not answer" in self.texts[-1], 1.0, f"the reason in {self.texts}")
        os.killpg(order.pid, signal.SIGCONT)
        self.wheels_stay(0, 0, for_seconds=0.5)

    def test_ends_with_its_program_although_another_publisher_is_idle(self):
        order = self.driven_by_an_order(cmd_vel_timeout=0)
        self.assertTrue(self.commands().get_num_connections())
        order.kill()
        self.wait_for_stop(within=0.15)
        self.wait_for(lambda: "has ended" in self.texts[-1], 1.0, f"the reason in {self.texts}")
        self.wait_for(lambda: publishers("/cmd_vel") == [rospy.get_name()], 5.0, "the master to forget the killed one")

    def test_is_not_driven_again_when_its_connection_broke_off_and_another_program_comes(self):
        self.controller()
        self.commands().unregister()
        order = rospy.Publisher("/cmd_vel", Twist, queue_size=1, latch=True)
        self.addCleanup(order.unregister)
        self.wait_for(lambda: order.publish(twist(0.5)) or self.wheels() == (0.5, 0.5), START_TIMEOUT, "the order")
        before = order.impl.connections
        for connection in before:
            connection.socket.shutdown(socket.SHUT_RDWR)
        self.wait_for_stop(within=0.15)
        another = rosgraph.Master("/another")
        another.registerPublisher("/cmd_vel", Twist._type, "http://localhost:1/")
        self.addCleanup(another.unregisterPublisher, "/cmd_vel", "http://localhost:1/")
        self.wait_for(lambda: set(order.impl.connections) - set(before), 5.0, "a new connection")
        self.wheels_stay(0, 0, for_seconds=0.3)
        order.publish(twist(0.25))
        self.wait_for_wheels(0.25, 0.25)

    def test_a_restarted_controller_waits_until_it_is_repeated(self):
        before = set(publishers("/cmd_vel"))
        order = self.order()
        self.wait_for(lambda: set(publishers("/cmd_vel")) - before, START_TIMEOUT, "the order")
        self.controller()
        self.texts = self.status()
        self.wait_for(lambda: self.texts and "is from before, repeat it" in self.texts[-1], 5.0,
                      f"the reason in {self.texts}")
        self.wheels_stay(0, 0, for_seconds=0.5)
        order.kill()
        self.order()
        self.wait_for_wheels(0.5, 0.5, within=START_TIMEOUT)
