"""A laptop commands a robot over a network; the robot stops while the link is cut, and drives when it is back."""

import os
import subprocess
import unittest

from harness import START_TIMEOUT, RobotTest, end

ADDRESSES = {"robot": "10.77.0.1", "laptop": "10.77.0.2"}  # of two network namespaces, which nothing else can reach
COMMAND_TIMEOUT = 1.0     # s; the default of cmd_vel_timeout
RECONNECT_TIMEOUT = 15.0  # s; TCP waits longer and longer between two tries


class TwoComputers(RobotTest):
    def setUp(self):
        self.names = {host: f"{host}_{os.getpid()}" for host in ADDRESSES}
        for name in self.names.values():
            try:
                ip("netns", "add", name)
                self.addCleanup(ip, "netns", "delete", name)
                ip("-n", name, "link", "set", "lo", "up")
            except subprocess.CalledProcessError:
                raise unittest.SkipTest("this user may not create or enter network namespaces") from None
        super().setUp()
        robot, laptop = self.names.values()
        ip("-n", robot, "link", "add", "eth0", "type", "veth", "peer", "eth0", "netns", laptop)
        for host, address in ADDRESSES.items():
            ip("-n", self.names[host], "address", "add", f"{address}/24", "dev", "eth0")
            self.set_link(host, "up")

    def set_link(self, host, state):
        ip("-n", self.names[host], "link", "set", "eth0", state)

    def start_on(self, host, *command):
        """Start a command on a computer, with the variables of a network of two."""
        variables = {"ROS_HOSTNAME": ADDRESSES[host], "ROS_MASTER_URI": f"http://{ADDRESSES['robot']}:11311"}
        return self.start("ip", "netns", "exec", self.names[host], *command, env={**os.environ, **variables})

    def driven_by_the_laptop(self, *options):
        """Start rostopic pub with these options on the laptop; return it once the robot drives."""
        command = self.start_on("laptop", "rostopic", "pub", *options, "/cmd_vel", "geometry_msgs/Twist",
                                "{linear: {x: 0.5}}")
        self.wait_for_wheels(0.5, 0.5, within=START_TIMEOUT)
        return command

    def test_link_is_cut_and_returns(self):
        self.start_on("robot", "roslaunch", "jetbot_control_node", "jetbot_controller.launch",
                      f"i2c_bus:=fake:{self.bus}")
        # A standing order that the master knows before the controller subscribes is old, and moves nothing
        self.wait_for(lambda: "stopped: no command yet" in self.logs(), START_TIMEOUT, "the controller to subscribe")
        order = self.driven_by_the_laptop()
        self.set_link("robot", "down")
        self.wait_for_stop(within=1.2)
        self.set_link("robot", "up")
        self.wheels_stay(0, 0, for_seconds=2.0)
        end([order])
        self.driven_by_the_laptop("-r", "10")
        self.set_link("robot", "down")
        self.wait_for_stop(within=COMMAND_TIMEOUT + 0.5)
        self.wheels_stay(0, 0, for_seconds=1.0)
        self.set_link("robot", "up")
        self.wait_for_wheels(0.5, 0.5, within=RECONNECT_TIMEOUT)


def ip(*arguments):
    subprocess.run(["ip", *arguments], check=True)
