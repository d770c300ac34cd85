#!/usr/bin/env python3
"""The controller's launch file: its arguments and YAML files reach the wheels."""

import rospkg

from harness import RobotTest, main

SI_UNITS = rospkg.RosPack().get_path("jetbot_control_node") + "/config/si_units.yaml"


class LaunchController(RobotTest):
    def launched(self, *arguments):
        self.launch("jetbot_control_node", "jetbot_controller.launch", *arguments)
        self.wait_for_controller()

    def test_defaults(self):
        self.launched()
        self.command(0.5, 0.1)
        self.wait_for_wheels(0.4, 0.6)

    def test_arguments(self):
        self.launched("wheel_separation:=0.2", "max_speed:=0.5", "left_motor_alpha:=0.5")
        self.command(0.2, 1.0)
        self.wait_for_wheels(0.1, 0.6)

    def test_an_argument_wins_over_the_file(self):
        self.launched(f"config:={SI_UNITS}", "max_speed:=1.2")
        self.command(0.3, 0.0)
        self.wait_for_wheels(0.25, 0.25)


if __name__ == "__main__":
    main(LaunchController)
