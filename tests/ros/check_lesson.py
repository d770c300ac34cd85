#!/usr/bin/env python3
"""check_lesson.py says what is missing in the running system, and tries the wheels."""

import os
import signal

import pexpect
import rosgraph
from jetbot_pro import Board

from harness import CONTROLLER, START, STILL, RobotTest, main, program, read
from jetbot_lessons.commands import publishes_at
from jetbot_lessons.graph import publishes
from jetbot_lessons.table import first_missing
from jetbot_lessons.wheels import wheels_turn

RELEASE = "; release that with rostopic pub -1 /emergency_stop std_msgs/Bool false"
CHECK = program("jetbot_lessons", "check_lesson.py")


class CheckLesson(RobotTest):
    def finds(self, number, sentence):
        """Fail unless this is what the lesson's checks find."""
        self.assertEqual(first_missing(number), sentence)

    def says(self, arguments, sentence, exit_code=1, **environment):
        """Fail unless the program says just this."""
        process = self.start(CHECK, *arguments, env={**os.environ, **environment})
        process.wait(START)
        self.assertEqual((read(process).strip(), process.returncode), (sentence, exit_code))

    def listening(self, **parameters):
        """A controller, and nobody who commands it."""
        controller = self.controller(**parameters)
        self.commands().unregister()
        return controller

    def test_from_the_files_to_wheels_that_obey(self):
        self.says([], "Which lesson, 1 to 8? Type: rosrun jetbot_lessons check_lesson.py N, "
                      "and from lesson 7 on the name of your package")
        self.says(["1"], "Lesson 1: done.", exit_code=0)
        start = "start it in another terminal with rosrun jetbot_control_node jetbot_controller.py _i2c_bus:=fake"
        self.finds(2, f"There is no node /jetbot_controller: {start}")
        self.listening()
        self.finds(2, None)
        self.finds(3, None)
        self.assertEqual(self.wheels(), STILL)
        self.publisher()
        self.wait_for_wheels(0.5, 0.5, within=START)
        [node] = dict(rosgraph.Master("/test").getSystemState()[0])["/cmd_vel"]
        self.finds(3, f"{node} publishes on /cmd_vel: end it with Ctrl-C in its terminal, then try again")

    def test_no_master(self):
        nowhere = "http://localhost:1"
        self.says(["2"], f"Lesson 2: No ROS master at {nowhere}: start one in another terminal with roscore",
                  ROS_MASTER_URI=nowhere)

    def test_wheels_do_not_obey(self):
        self.listening()
        self.emergency_stop(True)
        self.finds(3, "The wheels do not obey: at x 0.3 they turn at 0.00 and 0.00, "
                      "and the controller says 'stopped: emergency stop'" + RELEASE)
        self.assertEqual(wheels_turn(), "The wheels stand, and the controller says 'stopped: emergency stop'" + RELEASE)
        self.emergency_stop(False)

    def test_wheels_turn_the_wrong_way(self):
        self.listening(invert_left="true")
        self.finds(3, "The wheels do not obey: at x 0.3 they turn at -0.30 and 0.30, and the controller says 'driving'")
        self.wait_for_stop(within=1.0)

    def test_frozen_controller(self):
        controller = self.listening()
        os.killpg(controller.pid, signal.SIGSTOP)
        self.assertIn("The node /jetbot_controller does not answer: ", first_missing(2))

    def test_two_nodes_without_a_launch_file(self):
        self.listening()
        self.start(program("workshop", "jetbot_motion_control.py"))
        self.wait_for_wheels(0.4, 0.6, within=START)
        self.finds(6, "No launch file runs jetbot_control_node and workshop: end what runs, and start it with "
                      "roslaunch; where you did so, read what it shows, and look at pkg and type of each <node>")

    def test_scenario(self):
        self.launch("workshop", "workshop_jetbot_controller.launch")
        self.wait_for_wheels(0.4, 0.6, within=START)
        self.finds(5, None)
        self.finds(6, None)

    def test_another_rate(self):
        self.start(program("workshop", "jetbot_motion_control.py"), "_rate:=5")
        self.wait_for(lambda: publishes("workshop", "/cmd_vel", "") is None, START, "the motion node")
        self.assertRegex(publishes_at("workshop", 10, "hurry"),
                         r"^/jetbot_motion_control publishes [45]\.\d times a second, not 10: hurry$")

    def test_asks_what_a_real_robot_did(self):
        board = Board(os.path.join(self.folder, "tty"))
        self.addCleanup(board.unplug)
        self.start(CONTROLLER, "_board:=jetbot_pro", f"_port:={self.folder}/tty", "_cmd_vel_timeout:=0")
        self.wait_for(lambda: first_missing(2) is None, START, "the controller")
        for answer, sentence in (("y", "Lesson 3: done."), ("n", "Lesson 3: The wheels do not obey: see what rosrun ")):
            terminal = pexpect.spawn(CHECK, ["3"], timeout=START, encoding="utf-8")
            self.addCleanup(terminal.close)
            terminal.expect("Put the robot on a box, wheels in the air")
            self.assertIn(board.velocity, (None, (0, 0)))
            terminal.sendline()
            self.wait_for(lambda: board.velocity == (300, 0), START, "the robot to move")
            terminal.expect("Did both wheels turn forward, and stop?")
            self.wait_for(lambda: board.velocity == (0, 0), START, "the robot to stand while its owner answers")
            terminal.sendline(answer)
            terminal.expect_exact(sentence)


if __name__ == "__main__":
    main(CheckLesson)
