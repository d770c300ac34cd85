"""SparkFun's motor driver obeys, with its own failsafe armed, also after a hang and a brown-out."""

import os
import signal
from pathlib import Path

from harness import RobotTest, wheel_speeds
from jetbot.fake.bus import power_on

MA_DRIVE, MOTOR_OFF = 0x20, 0x80    # register of the left motor
FSAFE_TIME, ONE_SECOND = 0x76, 100  # register of the failsafe, in units of 10 ms


class Sparkfun(RobotTest):
    def wheels(self):
        return wheel_speeds(self.bus, "sparkfun")

    def driving_controller(self):
        """Start a controller that drives, and whose board has the failsafe armed."""
        node = self.controller(board="sparkfun", cmd_vel_timeout=0)
        self.drive_at(0.5)
        self.wait_for_register(FSAFE_TIME, ONE_SECOND, within=1.0)
        return node

    def wait_for_register(self, register, value, within):
        self.wait_for(lambda: Path(self.bus, "0x5d").read_bytes()[register] == value, within,
                      f"register 0x{register:02x} to hold {value}")

    def test_timeout_0_holds_the_last_command_beyond_the_failsafe(self):
        self.driving_controller()
        self.wheels_stay(0.5, 0.5, for_seconds=2.0)

    def test_brown_out(self):
        self.driving_controller()
        power_on(self.bus)
        self.assertEqual(self.wheels(), (0, 0))
        self.wait_for_wheels(0.5, 0.5, within=0.6)
        self.wait_for_register(FSAFE_TIME, ONE_SECOND, within=1.0)

    def test_hang(self):
        node = self.driving_controller()
        os.killpg(node.pid, signal.SIGSTOP)
        self.wait_for_register(MA_DRIVE, MOTOR_OFF, within=3.0)
        os.killpg(node.pid, signal.SIGCONT)
        self.wait_for_wheels(0.5, 0.5)
        self.wait_for_register(FSAFE_TIME, ONE_SECOND, within=1.0)
