#!/usr/bin/env python3
"""The wheels stop when the node, or roslaunch above it, is told to end."""

import os
import signal

import rosgraph
from ports import free_port

from harness import CONTROLLER, START, RobotTest, main, program

ENDINGS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class StopAtShutdown(RobotTest):
    def test_node(self):
        for ending in ENDINGS:
            with self.subTest(ending):
                node = self.controller(cmd_vel_timeout=0)
                self.command(0.5)
                self.wait_for_wheels(0.5, 0.5)
                node.send_signal(ending)
                self.wait_for_stop(within=0.7)
                self.assertEqual(node.wait(START), 0)
                self.wait_for(lambda: not self.commands().get_num_connections(), START, "the node to unsubscribe")

    def test_roslaunch(self):
        for ending in ENDINGS:
            with self.subTest(ending):
                launch = self.launch("workshop", "workshop_jetbot_controller.launch")
                self.wait_for_wheels(0.4, 0.6, within=START)
                launch.send_signal(ending)
                self.wait_for_stop(within=0.7)
                launch.wait(START)

    def test_node_without_an_answer_from_the_master(self):
        home = {**os.environ, "ROS_MASTER_URI": f"http://localhost:{free_port()}"}
        master = self.start("roscore", "-p", home["ROS_MASTER_URI"].rpartition(":")[2])
        self.wait_for(lambda: rosgraph.is_master_online(home["ROS_MASTER_URI"]), START, "the master")
        node = self.start(CONTROLLER, f"_i2c_bus:=fake:{self.bus}", "_cmd_vel_timeout:=0", env=home)
        self.start(program("workshop", "jetbot_motion_control.py"), env=home)
        self.wait_for_wheels(0.4, 0.6, within=START)
        os.killpg(master.pid, signal.SIGSTOP)
        node.send_signal(signal.SIGTERM)
        self.wait_for_stop(within=0.7)


if __name__ == "__main__":
    main(StopAtShutdown)
