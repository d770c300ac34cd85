#!/usr/bin/env python3
"""When the controller itself is killed or frozen, the wheels stop, under roslaunch and without."""

import contextlib
import os
import signal
from pathlib import Path

from harness import START, RobotTest, main, read
from jetbot_lessons.graph import pid

LIMIT = 1.5  # seconds from the blow to the stop


class Crash(RobotTest):
    def test_roslaunch(self):
        launch = self.launch("workshop", "workshop_jetbot_controller.launch")
        self.wait_for_wheels(0.4, 0.6, within=START)
        os.kill(pid("/jetbot_controller"), signal.SIGKILL)
        self.wait_for_stop(within=LIMIT)
        self.wheels_stay(0, 0, for_seconds=1)
        launch.wait(START)

    def driving_controller(self):
        """A controller that would drive on for ever."""
        node = self.controller(cmd_vel_timeout=0)
        self.command(0.5)
        self.wait_for_wheels(0.5, 0.5)
        return node

    def test_without_roslaunch(self):
        node = self.driving_controller()
        os.killpg(node.pid, signal.SIGKILL)
        self.wait_for_stop(within=LIMIT)

    def test_killed_after_its_guard(self):
        node = self.driving_controller()
        self.wait_for(self.guard, START, "the guard")
        first = self.guard()
        os.kill(first, signal.SIGKILL)
        self.wait_for(lambda: self.guard() not in (None, first), 2.0, "another guard")
        os.killpg(node.pid, signal.SIGKILL)
        self.wait_for_stop(within=LIMIT)

    def test_killed_without_the_board_that_comes_back_later(self):
        node = self.driving_controller()
        os.rename(self.bus + "/0x60", self.bus + "/cable_is_out")
        os.killpg(node.pid, signal.SIGKILL)
        node.wait()
        self.wait_for(lambda: "the wheels may still turn" in read(node), START, "the guard to miss the board")
        os.rename(self.bus + "/cable_is_out", self.bus + "/0x60")
        self.wait_for_stop(within=LIMIT)

    def test_roslaunch_itself_killed(self):
        launch = self.launch("jetbot_control_node", "jetbot_controller.launch", "cmd_vel_timeout:=0")
        self.wait_for_controller()
        self.command(0.5)
        self.wait_for_wheels(0.5, 0.5)
        launch.kill()
        self.wait_for_stop(within=LIMIT)
        self.wait_for(lambda: pid("/jetbot_controller") is None, START, "the controller to end, too")

    def guard(self):
        """The process id of the guard on this test's bus."""
        for path in Path("/proc").glob("[0-9]*"):
            with contextlib.suppress(OSError):
                if (path / "comm").read_text() == "jetbot_guard\n" and self.bus in (path / "cmdline").read_text():
                    return int(path.name)
        return None

    def test_frozen_controller(self):
        node = self.controller()
        self.commands().unregister()
        self.publisher()
        self.wait_for_wheels(0.5, 0.5, within=START)
        os.killpg(node.pid, signal.SIGSTOP)
        self.wait_for_stop(within=LIMIT)
        self.wheels_stay(0, 0, for_seconds=1)
        os.killpg(node.pid, signal.SIGCONT)
        self.wait_for_wheels(0.5, 0.5)


if __name__ == "__main__":
    main(Crash)
