"""The calibration at a real terminal, on a robot that is wired differently, ends in a robot that drives straight."""

import math
import os

import pexpect

from harness import START_TIMEOUT, RobotTest, program
from jetbot.fake.motors import STOPPED, wheel_speeds

DEAD_BAND = 0.006
WEAKNESS = 0.95
QUESTION = "Which w|Did the|How many"


class Calibration(RobotTest):
    """calibrate.py on a Waveshare board with swapped wires, one of them inverted, and a weak right motor."""

    def setUp(self):
        super().setUp()
        self.file = os.path.join(self.folder, "jetbot_fake.yaml")  # never the real robot's jetbot.yaml
        self.terminal = pexpect.spawn(
            program("jetbot_tools", "calibrate.py"), [f"_i2c_bus:=fake:{self.bus}"],
            env={**os.environ, "ROS_HOME": self.folder}, timeout=START_TIMEOUT, encoding="utf-8")
        self.addCleanup(self.terminal.close)
        self.answer("Put the robot on a box")

    def answer(self, question, text=""):
        self.terminal.expect(question)
        self.terminal.sendline(text)

    def drive(self, announcement):
        """Start a motion and end it by a key; return the speeds of the wheels, STOPPED if nothing turned."""
        self.answer(announcement)
        self.wait_for(lambda: self.wheels() != STOPPED or self.terminal.expect([pexpect.TIMEOUT, QUESTION], timeout=0),
                      START_TIMEOUT, "a motion")
        speeds = self.wheels()
        if speeds != STOPPED:
            self.terminal.send(" ")
            self.terminal.expect(QUESTION)
        self.assertEqual(self.wheels(), STOPPED, "after the motion")
        return speeds

    def wheels(self):
        left_output, right_output = map(motor, wheel_speeds(self.bus, "waveshare"))
        return right_output, -WEAKNESS * left_output

    def turn(self):
        left, right = self.drive("output will turn one wheel")
        if (left, right) == STOPPED:
            return self.terminal.sendline("none")
        self.terminal.sendline("l" if left else "r")
        return self.answer("Forward or backward", "f" if left + right > 0 else "b")

    def ramp(self, moving, turned):
        self.answer("press a key as soon as it turns")
        self.wait_for(moving, START_TIMEOUT, "the power to rise")
        self.terminal.send("x")
        self.wait_for_stop(within=1.0)
        self.answer("Did the .* wheel turn", turned)

    def straighten(self):
        while True:
            self.answer("drive ahead for 4 s")
            self.wait_for(lambda: min(self.wheels()) > 0.37, START_TIMEOUT, "the full speed of this motion")
            left, right = self.wheels()
            self.terminal.send(" ")
            self.terminal.expect(QUESTION)
            curvature = (right - left) / (0.1125 * (right + left) / 2)
            if abs(curvature) < 0.01:
                return self.terminal.sendline("")
            drift = (1 - math.sqrt(1 - curvature ** 2)) / curvature
            self.terminal.sendline(f"{abs(100 * drift):.1f} cm")
            self.answer("Left or right", "left" if drift > 0 else "r")

    def test_from_the_box_to_a_straight_line(self):
        for _ in range(4):  # two outputs as Adafruit's board has them, then two as Waveshare's
            self.turn()
        self.answer("Put the robot on the floor")
        for _ in ("left", "right"):
            self.ramp(lambda: wheel_speeds(self.bus, "waveshare") != STOPPED, "n")  # the key comes too early
            self.ramp(lambda: self.wheels() != STOPPED, "y")
        self.straighten()
        self.answer("Measure how far it drives")  # Enter alone skips it
        self.terminal.expect("To undo it: rm ")
        self.terminal.expect(pexpect.EOF)
        self.start("roslaunch", "jetbot_control_node", "jetbot_controller.launch", f"config:={self.file}")
        self.wait_for_controller()
        self.command(0.5)
        self.wait_for(lambda: min(self.wheels()) > 0.4, 5.0, "both wheels to turn forward")
        left, right = self.wheels()
        self.assertAlmostEqual(left / right, 1, delta=0.01)

    def interrupt_motion(self, interrupt, *arguments):
        """Interrupt the first motion while its wheel turns; fail unless the wheel stops within a second."""
        self.answer("any key stops it")
        self.wait_for(lambda: wheel_speeds(self.bus) != STOPPED, START_TIMEOUT, "a wheel to turn")
        interrupt(*arguments)
        self.wait_for(lambda: wheel_speeds(self.bus) == STOPPED, 1.0, "the wheel to stop")

    def test_any_key_ends_a_motion_and_ctrl_c_the_calibration(self):
        self.interrupt_motion(self.terminal.send, "x")
        self.answer("Which wheel turned", "l")
        self.answer("Forward or backward", "f")
        self.interrupt_motion(self.terminal.send, "\x03")
        self.terminal.expect("Cancelled: the wheels are stopped and nothing was written.")
        self.assertFalse(os.path.exists(self.file))

    def test_a_lost_terminal_ends_a_motion(self):
        self.interrupt_motion(self.terminal.close, False)


def motor(duty):
    """The speed of a motor that friction holds below a dead band."""
    return duty if abs(duty) >= DEAD_BAND else 0.0
