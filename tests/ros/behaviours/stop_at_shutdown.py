"""The wheels stop when the node, or roslaunch above it, is asked to end."""

import os
import signal

import rosgraph

from harness import CONTROLLER, START_TIMEOUT, RobotTest, free_port, program

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class StopAtShutdown(RobotTest):
    def test_node(self):
        for each in SIGNALS:
            node = self.controller(cmd_vel_timeout=0)
            self.drive_at(0.5)
            node.send_signal(each)
            self.wait_for_stop(within=0.7)
            self.assertEqual(node.wait(START_TIMEOUT), 0)
            self.wait_for(lambda: not self.commands().get_num_connections(), 5.0, "the node to unsubscribe")

    def test_roslaunch(self):
        for each in SIGNALS:
            launch = self.launch("workshop", "workshop_jetbot_controller.launch")
            self.wait_for_wheels(0.4, 0.6, within=START_TIMEOUT)
            launch.send_signal(each)
            self.wait_for_stop(within=0.7)
            launch.wait(START_TIMEOUT)

    def test_node_whose_master_hangs(self):
        port = str(free_port())
        environment = {**os.environ, "ROS_MASTER_URI": f"http://localhost:{port}"}
        master = self.start("roscore", "-p", port)
        self.wait_for(lambda: rosgraph.is_master_online(environment["ROS_MASTER_URI"]), START_TIMEOUT, "the master")
        node = self.start(CONTROLLER, f"_i2c_bus:=fake:{self.bus}", "_cmd_vel_timeout:=0", env=environment)
        self.start(program("workshop", "jetbot_motion_control.py"), env=environment)
        self.wait_for_wheels(0.4, 0.6, within=START_TIMEOUT)
        os.killpg(master.pid, signal.SIGSTOP)
        node.send_signal(signal.SIGTERM)
        self.wait_for_stop(within=0.7)
