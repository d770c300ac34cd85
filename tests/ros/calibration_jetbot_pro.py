#!/usr/bin/env python3
"""The calibration of a JetBot Pro that drives backward and to the left ends in one that drives straight ahead."""

import os

import pexpect
from jetbot_pro import STILL, Board

from harness import CONTROLLER, START, RobotTest, main

CURVATURE = 0.1  # 1/m, to the left, where it should be straight


class CalibrationOfAJetbotPro(RobotTest):
    def setUp(self):
        super().setUp()
        self.link = os.path.join(self.folder, "tty")
        self.board = Board(self.link)
        self.addCleanup(self.board.unplug)
        self.file = os.path.join(self.folder, "jetbot.yaml")
        self.terminal = pexpect.spawn(
            "rosrun", ["jetbot_control_node", "calibrate.py", "--board", "jetbot_pro", "--port", self.link,
                       "--output", self.file], timeout=START, encoding="utf-8")
        self.addCleanup(self.terminal.close)

    def motion(self):
        """How the robot moves, in m/s and rad/s: its motors are connected the wrong way round."""
        ahead, turn = (value / 1000 for value in self.board.velocity)
        return -ahead, turn - CURVATURE * ahead

    def start_motion(self, announcement):
        """Let a motion begin, end it by a key, and return how the robot moved."""
        self.terminal.expect(announcement)
        self.terminal.expect("Enter starts it")
        self.terminal.sendline()
        self.wait_for(lambda: self.board.velocity not in (None, STILL), START, "a motion")
        motion = self.motion()
        self.terminal.send(" ")
        self.wait_for(lambda: self.board.velocity == STILL, 0.5, "the robot to stop")
        return motion

    def answer(self, question, text=""):
        self.terminal.expect(question)
        self.terminal.sendline(text)

    def drift(self):
        """Let it drive ahead and tell the drift, which is 0 when it is straight enough."""
        ahead, turn = self.start_motion("drive ahead")
        drift = round(100 * turn / ahead / 2)
        self.answer("How many centimetres", f"{abs(drift)} cm")
        if drift:
            self.answer("To the left or to the right", "left" if drift > 0 else "right")
        return drift

    def test_from_the_box_to_a_straight_line(self):
        self.answer("Put the robot on a box")
        ahead, _ = self.start_motion("as if to drive ahead")
        self.answer("Which way did the wheels turn", "forward" if ahead > 0 else "backward")
        _, turn = self.start_motion("turn on the spot, to the left")
        self.answer("Which wheel turned forward", "right" if turn > 0 else "left")
        self.answer("put it on the floor")
        while self.drift() != 0:
            self.terminal.expect("see whether it is straight now")
        self.terminal.expect("To undo it: rm ")
        self.terminal.expect(pexpect.EOF)
        self.start(*CONTROLLER, f"_config:={self.file}")
        self.wait_for(lambda: self.commands().get_num_connections(), START, "the controller to subscribe")
        self.command(0.5)
        self.wait_for(lambda: self.board.velocity != STILL, 5.0, "the robot to drive")
        ahead, turn = self.motion()
        self.assertGreater(ahead, 0.4)
        self.assertAlmostEqual(turn / ahead, 0, delta=0.01)


if __name__ == "__main__":
    main(CalibrationOfAJetbotPro)
