"""The calibration of a JetBot Pro that drives backward and turns the right way ends in one that does both right."""

from behaviours.calibration import CalibrationTest
from harness import near
from jetbot.fake.motors import wheel_speeds


class CalibrationOfAJetBotPro(CalibrationTest):
    link = "port:=fake"

    def wheels(self):
        """The wheels of a robot whose motors are connected to each other's outputs, both the wrong way round."""
        left, right = wheel_speeds(self.bus, "jetbot_pro")
        return -right, -left

    def test_from_the_box_to_the_right_way(self):
        left, right = self.drive("as if to drive ahead")
        self.terminal.sendline("forward" if left + right > 0 else "backward")
        left, right = self.drive("as if to turn left on the spot")
        self.terminal.sendline("right" if right > left else "left")
        self.start_calibrated_robot()
        self.command(0.5, 0.2)
        self.wait_for(lambda: near(self.wheels(), (0.3, 0.7)), 5.0, "the robot to drive as commanded")
