#!/usr/bin/env python3
"""The controller's launch file: a typed argument wins over the YAML file, the file over the default."""

import os
import struct
from pathlib import Path

from harness import RobotTest, main


class LaunchController(RobotTest):
    def launched(self, *arguments, **options):
        self.launch("jetbot_control_node", "jetbot_controller.launch", *arguments, **options)
        self.wait_for_controller()

    def launched_with_a_file(self, *arguments):
        file = Path(self.folder, "robot.yaml")
        file.write_text("max_speed: 0.5\nleft_motor_alpha: 0.5\n")
        self.launched(f"config:={file}", *arguments)

    def test_defaults(self):
        self.launched()
        self.command(0.5, 0.1)
        self.wait_for_wheels(0.4, 0.6)

    def test_arguments(self):
        self.launched("wheel_separation:=0.2", "max_speed:=0.5", "left_motor_alpha:=0.5")
        self.command(0.2, 1.0)
        self.wait_for_wheels(0.1, 0.6)

    def test_an_argument_wins_over_the_file_also_where_it_equals_the_default(self):
        self.launched_with_a_file("max_speed:=1.0", "left_motor_alpha:=0.75")
        self.command(0.4)
        self.wait_for_wheels(0.3, 0.4)

    def test_the_file_wins_over_the_default_where_an_argument_is_empty_or_missing(self):
        self.launched_with_a_file("max_speed:=")
        self.command(0.4)
        self.wait_for_wheels(0.4, 0.8)

    def test_a_twist_reaches_a_jetbot_pro_unchanged(self):
        home = Path(self.folder, "home")
        self.launched("board:=jetbot_pro", "port:=fake", env={**os.environ, "ROS_HOME": str(home)})
        board = home / "fake_i2c/jetbot_pro"  # holds the last frame; its payload: vx, vy in mm/s, wz in mrad/s
        for x, z in (500, 1000), (0, 2000), (800, -700):
            self.command(x / 1000, z / 1000)
            payload = struct.pack(">3h", x, 0, z)
            self.wait_for(lambda payload=payload: board.read_bytes()[4:-1] == payload, 5.0, f"{x} mm/s, {z} mrad/s")


if __name__ == "__main__":
    main(LaunchController)
