#!/usr/bin/env python3
"""The calibration at a real terminal, on a robot that is wired otherwise, ends in a robot that drives straight."""

import math
import os
import time

import pexpect

from harness import START, STILL, RobotTest, main, program, wheel_speeds

DEAD_BAND = 0.12
WEAKNESS = 0.95


class Calibration(RobotTest):
    def setUp(self):
        super().setUp()
        self.file = os.path.join(self.folder, "jetbot.yaml")
        self.terminal = pexpect.spawn(
            program("jetbot_control_node", "calibrate.py"), ["--i2c-bus", f"fake:{self.bus}", "--output", self.file],
            timeout=START, encoding="utf-8")
        self.addCleanup(self.terminal.close)

    def wheels(self):
        """The wheels of a Waveshare board with swapped wires, one of them inverted, and a weak right motor."""
        left_output, right_output = map(motor, wheel_speeds(self.bus, "waveshare"))
        return right_output, -WEAKNESS * left_output

    def answer(self, question, text=""):
        self.terminal.expect(question)
        self.terminal.sendline(text)

    def watch_motion(self):
        """The wheels' speeds in the midst of the motion that starts now, and STILL where nothing turns."""
        speeds = STILL
        while not self.terminal.expect([pexpect.TIMEOUT, r"Which wheel|Did the|How many cent"], timeout=0.02):
            if speeds == STILL and self.wheels() != STILL:
                speeds = self.wheels()
                self.terminal.send(" ")  # seen enough
        self.assertEqual(self.wheels(), STILL, "after the motion")
        return speeds

    def turn(self):
        self.answer("Enter starts it, any key stops it")
        left, right = self.watch_motion()
        if (left, right) == STILL:
            return self.terminal.sendline("none")
        self.terminal.sendline("l" if left else "r")
        return self.answer("Forward or backward", "f" if left + right > 0 else "b")

    def straighten(self):
        while True:
            self.answer("drive ahead for 4 s. Enter starts it")
            left, right = self.watch_motion()
            curvature = (right - left) / (0.1125 * (right + left) / 2)
            if abs(curvature) < 0.01:
                return self.terminal.sendline("")
            drift = (1 - math.sqrt(1 - curvature ** 2)) / curvature
            self.terminal.sendline(f"{abs(100 * drift):.1f} cm")
            self.answer("left or to the right", "left" if drift > 0 else "r")

    def ramp(self):
        self.answer("press any key as soon as it turns")
        self.wait_for(lambda: wheel_speeds(self.bus, "waveshare") != STILL, START, "the power to rise")
        self.terminal.send("x")
        self.answer("Did the .* wheel turn", "n")  # the key came too early
        self.answer("press any key as soon as it turns")
        self.wait_for(lambda: self.wheels() != STILL, START, "the wheel to turn")
        self.terminal.send(" ")
        self.wait_for_stop(within=1.0)
        self.answer("Did the .* wheel turn", "y")

    def test_from_the_box_to_a_straight_line(self):
        self.answer("Put the robot on a box")
        for _ in range(4):  # two outputs as Adafruit's board has them, then two as Waveshare's
            self.turn()
        self.answer("put it on the floor")
        self.ramp()
        self.ramp()
        self.straighten()
        self.terminal.expect("To undo it: rm ")
        self.terminal.expect(pexpect.EOF)
        self.launch("jetbot_control_node", "jetbot_controller.launch", f"config:={self.file}")
        self.wait_for_controller()
        self.command(0.5)
        self.wait_for(lambda: min(self.wheels()) > 0.4, 5.0, "both wheels to turn forward")
        left, right = self.wheels()
        self.assertAlmostEqual(left / right, 1, delta=0.01)

    def test_any_key_ends_a_motion(self):
        self.answer("Put the robot on a box")
        for key in ("x", "\x03"):
            self.answer("Enter starts it, any key stops it")
            self.wait_for(lambda: wheel_speeds(self.bus) != STILL, START, "a wheel to turn")
            self.terminal.send(key)
            self.wait_for(lambda: wheel_speeds(self.bus) == STILL, 1.0, "the wheels to stop")
            if key == "x":
                self.answer("Which wheel turned", "l")
                self.answer("Forward or backward", "f")
        self.terminal.expect("Ended; the wheels stand and nothing was written.")
        self.assertFalse(os.path.exists(self.file))

    def test_a_lost_terminal_ends_a_motion(self):
        self.answer("Put the robot on a box")
        self.answer("Enter starts it, any key stops it")
        self.wait_for(lambda: wheel_speeds(self.bus) != STILL, START, "a wheel to turn")
        lost = time.monotonic()
        self.terminal.close(force=False)
        self.wait_for(lambda: wheel_speeds(self.bus) == STILL, 1.0, "the wheels to stop")
        self.assertLess(time.monotonic() - lost, 1.0)


def motor(duty):
    """The speed of a motor that friction holds below a dead band."""
    return math.copysign(max(0.0, abs(duty) - DEAD_BAND) / (1 - DEAD_BAND), duty)


if __name__ == "__main__":
    main(Calibration)
