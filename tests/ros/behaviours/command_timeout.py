"""The robot stops when its commander sends nothing more, freezes or dies, and drives again at the next command."""

import os
import signal

from harness import START_TIMEOUT, RobotTest


class CommandTimeout(RobotTest):
    def driven_by_a_process(self, timeout):
        """Return the process that makes a controller with this timeout drive."""
        self.controller(cmd_vel_timeout=timeout)
        self.commands().unregister()
        publisher = self.publisher()
        self.wait_for_wheels(0.5, 0.5, within=START_TIMEOUT)
        return publisher

    def test_no_command_for_the_timeout(self):
        self.controller(cmd_vel_timeout=0.5)
        texts = self.status()
        self.drive_at(0.5)
        self.wheels_stay(0.5, 0.5, for_seconds=0.3)
        self.wait_for_stop(within=0.4)
        self.wait_for_status(texts, "stopped: no command for 0.5 s (repeat it: rostopic pub -r 10)")
        self.drive_at(0.5)
        self.wait_for_status(texts, "driving")

    def test_frozen_publisher(self):
        publisher = self.driven_by_a_process(timeout=1.0)
        os.killpg(publisher.pid, signal.SIGSTOP)
        self.wait_for_stop(within=1.2)
        os.killpg(publisher.pid, signal.SIGCONT)
        self.wait_for_wheels(0.5, 0.5)

    def test_killed_publisher(self):
        publisher = self.driven_by_a_process(timeout=0)
        os.killpg(publisher.pid, signal.SIGKILL)
        self.wait_for_stop(within=0.15)
