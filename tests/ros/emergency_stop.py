#!/usr/bin/env python3
"""An emergency stop stops every robot, also one that joins later, until it is released and a new command comes."""

from harness import RobotTest, main


class EmergencyStop(RobotTest):
    def drive(self, seconds):
        """Go on commanding, and see that nothing moves."""
        for _ in range(int(seconds / 0.05)):
            self.command(0.5)
            self.wheels_stay(0, 0, for_seconds=0.05)

    def test_stop_latch_release(self):
        self.controller(cmd_vel_timeout=0)
        texts = self.status()
        self.command(0.5)
        self.wait_for_wheels(0.5, 0.5)
        self.emergency_stop(True)
        self.wait_for_stop(within=1.0)
        self.wait_for_status(texts, "stopped: emergency stop")
        self.drive(seconds=0.5)
        self.emergency_stop(False)
        self.wait_for_status(texts, "stopped: no command since the emergency stop was released")
        self.wheels_stay(0, 0, for_seconds=0.3)
        self.command(0.25)
        self.wait_for_wheels(0.25, 0.25)

    def test_stops_a_robot_that_joins_later(self):
        self.emergency_stop(True)
        texts = self.status()
        self.controller()
        self.wait_for_status(texts, "stopped: emergency stop")
        self.drive(seconds=0.3)
        self.emergency_stop(False)


if __name__ == "__main__":
    main(EmergencyStop)
