#!/usr/bin/env python3
"""The workshop's launch file starts both nodes and passes its arguments on."""

import runpy
import xml.etree.ElementTree as ET
from pathlib import Path

import rosgraph
import rospy
from rospkg import RosPack

from harness import START_TIMEOUT, RobotTest, main, wheel_speeds

WORKSHOP = Path(RosPack().get_path("workshop"))


class LaunchWorkshop(RobotTest):
    def launch_workshop(self, *arguments):
        self.launch("workshop", "workshop_jetbot_controller.launch", *arguments)

    def test_drives_the_workshops_motion(self):
        rospy.set_param("/jetbot_motion_control/linear", 0.2)  # left by an earlier start
        self.launch_workshop()
        self.wait_for_wheels(0.4, 0.6, within=START_TIMEOUT)

    def test_passes_arguments_on(self):
        self.launch_workshop("board:=waveshare", "max_speed:=2", "linear:=1.0", "angular:=0.0")
        self.wait_for(lambda: wheel_speeds(self.bus, "waveshare") == (0.5, 0.5), START_TIMEOUT,
                      "the Waveshare board's wheels")
        self.assertEqual(self.wheels(), (0, 0), "and not the Adafruit board's")

    def test_documents_the_nodes_defaults(self):
        rows = runpy.run_path(str(WORKSHOP / "scripts/jetbot_motion_control.py"))["PARAMETERS"]
        arguments = ET.parse(WORKSHOP / "launch/workshop_jetbot_controller.launch").iter("arg")
        docs = {argument.get("name"): argument.get("doc") for argument in arguments}
        for name, row in rows.items():
            self.assertEqual(docs[name], f"{row.doc} ({row.default} {row.unit})")

    def test_robot_name_is_the_namespace_of_both_nodes(self):
        self.launch_workshop("robot_name:=red")
        self.wait_for_wheels(0.4, 0.6, within=START_TIMEOUT)
        publishers, subscribers, _ = map(dict, rosgraph.Master("/test").getSystemState())
        self.assertEqual(publishers["/red/cmd_vel"], ["/red/jetbot_motion_control"])
        self.assertEqual(subscribers["/red/cmd_vel"], ["/red/jetbot_controller"])


if __name__ == "__main__":
    main(LaunchWorkshop)
