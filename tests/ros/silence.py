#!/usr/bin/env python3
"""The robot stops when its commander falls silent, freezes or dies, and drives again at the next command."""

import os
import signal

from harness import START, RobotTest, main

LOST = 0.15  # seconds from a publisher's death to the stop


class Silence(RobotTest):
    def driving(self, timeout):
        """A controller, and a process of its own that drives it."""
        self.controller(cmd_vel_timeout=timeout)
        self.commands().unregister()
        publisher = self.publisher()
        self.wait_for_wheels(0.5, 0.5, within=START)
        return publisher

    def test_silent(self):
        self.controller(cmd_vel_timeout=0.5)
        texts = self.status()
        self.command(0.5)
        self.wait_for_wheels(0.5, 0.5)
        self.wheels_stay(0.5, 0.5, for_seconds=0.3)
        self.wait_for_stop(within=0.4)
        self.wait_for_status(texts, "stopped: no command for 0.5 s")
        self.command(0.5)
        self.wait_for_wheels(0.5, 0.5)
        self.wait_for_status(texts, "driving")

    def test_timeout_0_holds_the_last_command(self):
        self.controller(cmd_vel_timeout=0)
        self.command(0.5)
        self.wait_for_wheels(0.5, 0.5)
        self.wheels_stay(0.5, 0.5, for_seconds=2)

    def test_frozen(self):
        publisher = self.driving(timeout=1.0)
        os.killpg(publisher.pid, signal.SIGSTOP)
        self.wait_for_stop(within=1.2)
        os.killpg(publisher.pid, signal.SIGCONT)
        self.wait_for_wheels(0.5, 0.5)

    def test_killed(self):
        publisher = self.driving(timeout=0)
        os.killpg(publisher.pid, signal.SIGKILL)
        self.wait_for_stop(within=LOST)


if __name__ == "__main__":
    main(Silence)
