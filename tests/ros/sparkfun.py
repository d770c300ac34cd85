#!/usr/bin/env python3
"""SparkFun's motor driver obeys, keeps driving while its failsafe is fed, and comes back from a brown-out."""

import os
import signal
from pathlib import Path

from harness import RobotTest, main, near, wheel_speeds
from jetbot.fake.bus import power_on


class Sparkfun(RobotTest):
    def wheels(self):
        return wheel_speeds(self.bus, "sparkfun")

    def chip(self):
        return Path(self.bus, "0x5d").read_bytes()

    def test_drives_on_beyond_the_failsafe_and_returns(self):
        self.controller(board="sparkfun", cmd_vel_timeout=0)
        self.command(0.5)
        self.wait_for_wheels(0.5, 0.5)
        self.wheels_stay(0.5, 0.5, for_seconds=2.0)
        power_on(self.bus)
        self.wait_for_wheels(0.5, 0.5, within=0.6)

    def test_the_failsafe_is_still_set_after_a_hang(self):
        node = self.controller(board="sparkfun", cmd_vel_timeout=0)
        self.command(0.5)
        self.wait_for_wheels(0.5, 0.5)
        os.killpg(node.pid, signal.SIGSTOP)
        self.wait_for(lambda: self.chip()[0x20] == 0x80, 3.0, "the guard to stop the wheels")
        os.killpg(node.pid, signal.SIGCONT)
        self.wait_for_wheels(0.5, 0.5)
        self.assertEqual(self.chip()[0x76], 100)

    def test_stops_in_silence(self):
        self.controller(board="sparkfun", cmd_vel_timeout=0.5)
        self.command(-1.0)
        self.wait_for(lambda: near(self.wheels(), (-1 + 1 / 128, -1 + 1 / 128)), 2.0, "full backward")
        self.wait_for_stop(within=0.8)


if __name__ == "__main__":
    main(Sparkfun)
