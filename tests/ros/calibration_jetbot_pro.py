#!/usr/bin/env python3
"""The calibration of a JetBot Pro that drives backward and turns the right way ends in one that does both right."""

import os

import pexpect
from jetbot_pro import STILL, Board

from harness import CONTROLLER, START, RobotTest, main, program


class CalibrationOfAJetBotPro(RobotTest):
    def setUp(self):
        super().setUp()
        self.link = os.path.join(self.folder, "tty")
        self.board = Board(self.link)
        self.addCleanup(self.board.unplug)
        self.file = os.path.join(self.folder, "jetbot.yaml")
        self.terminal = pexpect.spawn(
            program("jetbot_control_node", "calibrate.py"),
            ["--board", "jetbot_pro", "--port", self.link, "--output", self.file], timeout=START, encoding="utf-8")
        self.addCleanup(self.terminal.close)

    def motion(self):
        """How the robot moves, in m/s and rad/s: its motors are connected the wrong way round."""
        ahead, turn = (value / 1000 for value in self.board.velocity)
        return -ahead, turn

    def start_motion(self, announcement):
        """Let a motion begin, end it by a key, and return how the robot moved."""
        self.terminal.expect(announcement)
        self.terminal.expect("Enter starts it")
        self.terminal.sendline()
        self.wait_for(lambda: self.board.velocity not in (None, STILL), START, "a motion")
        motion = self.motion()
        self.terminal.send(" ")
        self.wait_for(lambda: self.board.velocity == STILL, 1.0, "the robot to stop")
        return motion

    def answer(self, question, text=""):
        self.terminal.expect(question)
        self.terminal.sendline(text)

    def test_from_the_box_to_the_right_way(self):
        self.answer("Put the robot on a box")
        ahead, _ = self.start_motion("as if to drive ahead")
        self.answer("Which way did the wheels turn", "forward" if ahead > 0 else "backward")
        _, turn = self.start_motion("turn on the spot, to the left")
        self.answer("Which wheel turned forward", "right" if turn > 0 else "left")
        self.terminal.expect("To undo it: rm ")
        self.terminal.expect(pexpect.EOF)
        self.start(CONTROLLER, f"_config:={self.file}")
        self.wait_for_controller()
        self.command(0.5, 0.2)
        self.wait_for(lambda: self.board.velocity != STILL, 5.0, "the robot to drive")
        self.assertEqual(self.motion(), (0.5, 0.2))


if __name__ == "__main__":
    main(CalibrationOfAJetBotPro)
