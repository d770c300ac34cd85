#!/usr/bin/env python3
"""The controller's launch file: a typed argument wins over the YAML file, the file over the default."""

from pathlib import Path

import rospkg

from harness import RobotTest, main

SI_UNITS = rospkg.RosPack().get_path("jetbot_control_node") + "/config/si_units.yaml"


class LaunchController(RobotTest):
    def launched(self, *arguments):
        self.launch("jetbot_control_node", "jetbot_controller.launch", *arguments)
        self.wait_for_controller()

    def assert_speed(self, speed, *arguments):
        """Fail unless 0.3 m/s means this speed with these arguments and a file that sets max_speed to 0.5."""
        file = Path(self.folder, "robot.yaml")
        file.write_text("max_speed: 0.5\n")
        self.launched(f"config:={file}", *arguments)
        self.command(0.3)
        self.wait_for_wheels(speed, speed)

    def test_defaults(self):
        self.launched()
        self.command(0.5, 0.1)
        self.wait_for_wheels(0.4, 0.6)

    def test_arguments(self):
        self.launched("wheel_separation:=0.2", "max_speed:=0.5", "left_motor_alpha:=0.5")
        self.command(0.2, 1.0)
        self.wait_for_wheels(0.1, 0.6)

    def test_si_units(self):
        self.launched(f"config:={SI_UNITS}")
        self.command(0.3, 1.0)
        self.wait_for_wheels(0.40625, 0.59375)

    def test_the_file_wins_over_the_default(self):
        self.assert_speed(0.6)

    def test_an_empty_argument_counts_as_not_given(self):
        self.assert_speed(0.6, "max_speed:=")

    def test_an_argument_wins_over_the_file(self):
        self.assert_speed(0.25, "max_speed:=1.2")

    def test_an_argument_that_equals_the_default_wins_over_the_file(self):
        self.assert_speed(0.3, "max_speed:=1.0")


if __name__ == "__main__":
    main(LaunchController)
