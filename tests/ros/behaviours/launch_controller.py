"""The controller's launch file: a typed argument wins over the YAML file, the file over the default."""

from pathlib import Path

from harness import RobotTest, near, wheel_speeds

TABLE = [  # x, z, left, right
    (0.5, 0.0, 0.5, 0.5), (-0.5, 0.0, -0.5, -0.5), (0.0, 0.4, -0.4, 0.4), (0.0, -0.4, 0.4, -0.4),
    (0.5, 0.1, 0.4, 0.6), (0.8, 0.7, 0.1, 1.0), (1.0, 2.0, -1.0, 1.0), (3.0, 0.0, 1.0, 1.0), (0.0, 0.0, 0.0, 0.0)]


class LaunchController(RobotTest):
    def launched(self, *arguments):
        self.launch("jetbot_control_node", "jetbot_controller.launch", *arguments)
        self.wait_for_controller()

    def launched_with_a_file(self, *arguments):
        file = Path(self.folder, "robot.yaml")
        file.write_text("max_speed: 0.5\nleft_motor_alpha: 0.5\n")
        self.launched(f"config:={file}", *arguments)

    def test_defaults_are_the_workshops_mixing(self):
        self.launched()
        for x, z, left, right in TABLE:
            self.command(x, z)
            self.wait_for_wheels(left, right)

    def test_a_board_at_another_address_with_its_own_duties_and_frequency(self):
        self.launched("board:=waveshare_hat", "i2c_address:=0x61", "min_duty:=0.1", "max_duty:=0.5",
                      "pwm_frequency:=50")
        self.command(0.5, 0.5)
        self.wait_for(lambda: near(wheel_speeds(self.bus, "waveshare_hat", 0x61), (0.0, 0.5)), 5.0, "the wheels")
        self.assertEqual(Path(self.bus, "0x61").read_bytes()[0xFE], 121)

    def test_an_argument_wins_over_the_file_also_where_it_equals_the_default(self):
        self.launched_with_a_file("max_speed:=1.0", "left_motor_alpha:=0.75")
        self.command(0.4)
        self.wait_for_wheels(0.3, 0.4)

    def test_the_file_wins_over_the_default_where_an_argument_is_empty_or_missing(self):
        self.launched_with_a_file("max_speed:=")
        self.command(0.4)
        self.wait_for_wheels(0.4, 0.8)
