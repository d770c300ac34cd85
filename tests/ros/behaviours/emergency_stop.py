"""An emergency stop holds every robot, also one started later, until it is released and a new command arrives."""

from harness import RobotTest


class EmergencyStop(RobotTest):
    def commands_are_ignored(self, for_seconds):
        for _ in range(int(for_seconds / 0.05)):
            self.command(0.5)
            self.wheels_stay(0, 0, for_seconds=0.05)

    def test_stop_and_release(self):
        self.controller(cmd_vel_timeout=0)
        texts = self.status()
        self.drive_at(0.5)
        self.emergency_stop(True)
        self.wait_for_stop(within=1.0)
        self.wait_for_status(texts, "stopped: emergency stop")
        self.commands_are_ignored(for_seconds=0.5)
        self.emergency_stop(False)
        self.wait_for_status(texts, "stopped: no command since the emergency stop was released")
        self.wheels_stay(0, 0, for_seconds=0.3)
        self.drive_at(0.25)

    def test_stops_a_robot_started_later(self):
        self.emergency_stop(True)
        texts = self.status()
        self.controller()
        self.wait_for_status(texts, "stopped: emergency stop")
        self.commands_are_ignored(for_seconds=0.3)
