"""check_lesson.py reports the first problem of the running system, and tests the wheels."""

import csv
import os
import signal

import pexpect

from behaviours.jetbot_pro import Board
from harness import CONTROLLER, START_TIMEOUT, RobotTest, program, publishers, read
from jetbot_lessons.lessons import first_problem

TURN = "{angular: {z: -0.05}}"
CHECK = program("jetbot_lessons", "check_lesson.py")


class CheckLesson(RobotTest):
    def pupil(self):
        """Start the pupil's rostopic pub, and wait until the master knows it."""
        self.start("rostopic", "pub", "-r", "10", "/cmd_vel", "geometry_msgs/Twist", TURN)
        self.wait_for(lambda: publishers("/cmd_vel"), START_TIMEOUT, "the command")

    def test_what_the_wheels_do_and_a_frozen_controller(self):
        controller = self.controller()
        self.commands().unregister()
        self.pupil()
        self.assertIsNone(first_problem(3))
        self.emergency_stop(True)
        self.wait_for_stop(within=1.0)
        self.assertRegex(first_problem(3), r"^The wheels do not follow your command: at x 0 and z -0\.05 they turn at "
                                           r"0\.00 and 0\.00, not 0\.05 and -0\.05, and the controller reports "
                                           "'stopped: emergency stop'; release it with ")
        self.emergency_stop(False)
        os.killpg(controller.pid, signal.SIGSTOP)
        self.assertRegex(first_problem(2), "^The node /jetbot_controller was killed or hangs: start it again with ")

    def test_asks_what_a_real_robot_did(self):
        board = Board(os.path.join(self.folder, "tty"))
        self.addCleanup(board.unplug)
        self.start(CONTROLLER, "_board:=jetbot_pro", f"_port:={self.folder}/tty", "_cmd_vel_timeout:=0")
        self.wait_for(lambda: first_problem(2) is None, START_TIMEOUT, "the controller")
        self.pupil()
        for answer, result in (("y", "Lesson 3: done."), ("n", "Lesson 3: The wheels do not follow your command: ")):
            terminal = pexpect.spawn(CHECK, ["3"], timeout=START_TIMEOUT, encoding="utf-8")
            self.addCleanup(terminal.close)
            terminal.expect("Does the robot turn on the spot, to the right")
            terminal.sendline(answer)
            terminal.expect_exact(result)

    def test_table_of_a_class(self):
        self.start(CONTROLLER, f"_i2c_bus:=fake:{self.bus}", "__ns:=/red")
        self.start("rostopic", "pub", "-r", "10", "/red/cmd_vel", "geometry_msgs/Twist", TURN)
        self.wait_for(lambda: first_problem(3, namespace="/red") is None, START_TIMEOUT, "red to turn")
        table = self.start(CHECK, "3", "--robots", "red", "blue")
        self.assertEqual(table.wait(START_TIMEOUT), 1)
        header, red, blue = csv.reader(read(table).splitlines())
        self.assertEqual((header, red), (["name", "lesson", "done", "problem"], ["red", "3", "yes", ""]))
        self.assertEqual(blue[:3], ["blue", "3", "no"])
        self.assertTrue(blue[3].startswith("There is no node /blue/jetbot_controller: start it in another terminal "))
