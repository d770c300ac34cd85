"""The workshop's scenario publishes its motion ten times a second, and its launch file passes its arguments on."""

import os
import runpy
import signal
import time
import xml.etree.ElementTree as ET
from pathlib import Path

import rosgraph
import rospy
from geometry_msgs.msg import Twist
from rospkg import RosPack

from harness import START_TIMEOUT, RobotTest, program, read, wheel_speeds
from jetbot_control_node.safety import MANUAL_PRIORITY

WORKSHOP = Path(RosPack().get_path("workshop"))
SCENARIO = program("workshop", "jetbot_motion_control.py")
LAUNCH = "workshop_jetbot_controller.launch"


class WorkshopScenario(RobotTest):
    def test_rate_and_values(self):
        rospy.set_param("/jetbot_motion_control/linear", 0.2)  # left by an earlier start
        self.launch("workshop", LAUNCH)
        self.wait_for_wheels(0.4, 0.6, within=START_TIMEOUT)
        received = []
        rospy.Subscriber("/cmd_vel", Twist, lambda twist: received.append((time.monotonic(), twist)))
        self.wait_for(lambda: len(received) > 30, START_TIMEOUT, "31 commands")
        (first, _), (last, _) = received[0], received[30]
        self.assertAlmostEqual(30 / (last - first), 10, delta=0.5)
        self.assertEqual({(twist.linear.x, twist.angular.z) for _, twist in received}, {(0.5, 0.1)})

    def drive_by_hand(self):
        """Start a program that has the cockpit's name; return it when its command is driven."""
        cockpit = self.start(SCENARIO, "__name:=jetbot_cockpit", "_linear:=-0.2", "_angular:=0.0")
        self.wait_for_wheels(-0.2, -0.2, within=START_TIMEOUT)
        return cockpit

    def test_waits_for_5_s_after_a_person_has_driven_whatever_ended_that(self):
        texts = self.status()
        self.controller(cmd_vel_timeout=0)
        self.start(SCENARIO)
        self.wait_for_wheels(0.4, 0.6, within=START_TIMEOUT)
        ignored = ", /jetbot_motion_control waits for the cockpit"
        cockpit = self.drive_by_hand()
        self.wait_for_status(texts, "driving" + ignored)
        self.wheels_stay(-0.2, -0.2, for_seconds=1.0)
        os.killpg(cockpit.pid, signal.SIGKILL)
        self.wait_for_stop(within=0.5)
        self.wait_for_status(texts, "stopped: /jetbot_cockpit has ended" + ignored)
        self.wheels_stay(0, 0, for_seconds=MANUAL_PRIORITY - 1)
        self.wait_for_wheels(0.4, 0.6)
        self.wait_for_status(texts, "driving")
        os.killpg(self.drive_by_hand().pid, signal.SIGSTOP)
        self.wait_for_stop(within=2.0)
        self.wait_for_status(texts, "stopped: /jetbot_cockpit does not answer" + ignored)

    def test_bad_parameter(self):
        node = self.start(SCENARIO, "_rate:=0")
        self.assertNotEqual(node.wait(START_TIMEOUT), 0)
        [line] = read(node).splitlines()
        self.assertIn("The parameter rate must be a number from 0.1 to 1000, not 0.", line)

    def test_passes_arguments_on(self):
        self.launch("workshop", LAUNCH, "board:=waveshare", "max_speed:=2", "linear:=1.0", "angular:=0.0")
        self.wait_for(lambda: wheel_speeds(self.bus, "waveshare") == (0.5, 0.5), START_TIMEOUT,
                      "the Waveshare board's wheels")
        self.assertEqual(self.wheels(), (0, 0), "and not the Adafruit board's")

    def test_documents_the_nodes_defaults(self):
        arguments = ET.parse(WORKSHOP / "launch" / LAUNCH).iter("arg")
        docs = {argument.get("name"): argument.get("doc") for argument in arguments}
        for name, row in runpy.run_path(str(WORKSHOP / "scripts/jetbot_motion_control.py"))["PARAMETERS"].items():
            self.assertEqual(docs[name], f"{row.doc} ({row.default} {row.unit})")

    def test_robot_name_is_the_namespace_of_both_nodes(self):
        self.launch("workshop", LAUNCH, "robot_name:=red")
        self.wait_for_wheels(0.4, 0.6, within=START_TIMEOUT)
        publishers, subscribers, _ = map(dict, rosgraph.Master("/test").getSystemState())
        self.assertEqual(publishers["/red/cmd_vel"], ["/red/jetbot_motion_control"])
        self.assertEqual(subscribers["/red/cmd_vel"], ["/red/jetbot_controller"])
