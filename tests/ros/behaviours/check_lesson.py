"""check_lesson.py reports the first problem of the running system, and tests the wheels."""

import os
import signal
from pathlib import Path

import pexpect
import rosgraph

from behaviours.jetbot_pro import Board
from harness import CONTROLLER, START_TIMEOUT, RobotTest, program, read
from jetbot.fake.motors import STOPPED
from jetbot_lessons.motion import check_wheels_turn
from jetbot_lessons.table import first_problem

RELEASE = "; release it with rostopic pub -1 /emergency_stop std_msgs/Bool false"
OBEY = r"The wheels do not follow the command: at x 0\.3 and z 0\.1"
CHECK = program("jetbot_lessons", "check_lesson.py")


class CheckLesson(RobotTest):
    def assert_problem(self, lesson, problem):
        """Fail unless this is the lesson's first problem."""
        self.assertEqual(first_problem(lesson), problem)

    def idle_controller(self, **parameters):
        """Start a controller that nobody commands."""
        controller = self.controller(**parameters)
        self.commands().unregister()
        return controller

    def test_no_controller(self):
        self.assert_problem(2, "There is no node /jetbot_controller: start it in another terminal with "
                               "rosrun jetbot_control_node jetbot_controller.py _i2c_bus:=fake")

    def test_wheels_obey_no_other_publisher(self):
        self.idle_controller()
        self.assert_problem(3, None)
        self.assertEqual(self.wheels(), STOPPED)
        self.publisher()
        self.wait_for_wheels(0.5, 0.5, within=START_TIMEOUT)
        [node] = dict(rosgraph.Master("/test").getSystemState()[0])["/cmd_vel"]
        self.assert_problem(3, f"{node} publishes on /cmd_vel: stop it with Ctrl-C in its terminal, then try again")

    def test_no_master(self):
        process = self.start(CHECK, "2", env={**os.environ, "ROS_MASTER_URI": "http://localhost:1"})
        self.assertEqual(process.wait(START_TIMEOUT), 1)
        self.assertEqual(read(process), "Lesson 2: No ROS master at http://localhost:1: "
                                        "start one in another terminal with roscore\n")

    def test_wheels_do_not_obey(self):
        self.idle_controller()
        self.emergency_stop(True)
        reported = rf", and the controller reports 'stopped: emergency stop, on a fake bus'{RELEASE}$"
        self.assertRegex(first_problem(3), rf"^{OBEY} they turn at 0\.00 and 0\.00, not 0\.20 and 0\.40{reported}")
        self.assertRegex(check_wheels_turn(), f"^The wheels do not turn{reported}")
        self.emergency_stop(False)

    def test_wheels_turn_the_wrong_way(self):
        self.idle_controller(invert_left="true")
        self.assertRegex(first_problem(3), rf"^{OBEY} they turn at -0\.20 and 0\.40, not 0\.20 and 0\.40, "
                                           "and the controller reports 'driving, on a fake bus'; "
                                           r"was it started with a parameter such as invert_left\?$")
        self.wait_for_stop(within=1.0)

    def test_file_of_settings_that_changes_the_motion(self):
        file = Path(self.folder, "settings.yaml")
        file.write_text("swap_motors: true\n")
        self.idle_controller(config=file)
        self.assertRegex(first_problem(3), rf"^{OBEY} they turn at 0\.40 and 0\.20, not 0\.20 and 0\.40, and the "
                                           "controller reports 'driving, on a fake bus'; it has settings from "
                                           f"{file}: start it without that file$")

    def test_frozen_controller(self):
        controller = self.idle_controller()
        os.killpg(controller.pid, signal.SIGSTOP)
        self.assert_problem(2, "The node /jetbot_controller was killed or hangs: start it again with "
                               "rosrun jetbot_control_node jetbot_controller.py _i2c_bus:=fake; "
                               "if it hangs, stop it first (after Ctrl-Z: fg, then Ctrl-C)")

    def test_two_nodes_without_a_launch_file(self):
        self.idle_controller()
        self.start(program("workshop", "jetbot_motion_control.py"))
        self.wait_for_wheels(0.4, 0.6, within=START_TIMEOUT)
        self.assert_problem(6, "No launch file runs jetbot_control_node and workshop: stop what runs, and start it "
                               "with roslaunch; if you did so, read its output, and check pkg and type of each <node>")

    def test_scenario_at_another_rate(self):
        self.launch("workshop", "workshop_jetbot_controller.launch", "rate:=5")
        self.wait_for_wheels(0.4, 0.6, within=START_TIMEOUT)
        self.assert_problem(5, None)
        self.assertRegex(first_problem(6),
                         r"^workshop publishes [45]\.\d times a second, not 10: start it without rate:=$")

    def test_asks_what_a_real_robot_did(self):
        board = Board(os.path.join(self.folder, "tty"))
        self.addCleanup(board.unplug)
        self.start(CONTROLLER, "_board:=jetbot_pro", f"_port:={self.folder}/tty", "_cmd_vel_timeout:=0")
        self.wait_for(lambda: first_problem(2) is None, START_TIMEOUT, "the controller")
        for answer, result in (("y", "Lesson 3: done."), ("n", "Lesson 3: The wheels do not follow the command: run ")):
            terminal = pexpect.spawn(CHECK, ["3"], timeout=START_TIMEOUT, encoding="utf-8")
            self.addCleanup(terminal.close)
            terminal.expect("Put the robot on a box, wheels in the air")
            self.assertIn(board.velocity, (None, (0, 0)))
            terminal.sendline()
            self.wait_for(lambda: board.velocity == (300, 0), START_TIMEOUT, "the robot to drive")
            terminal.expect("Did both wheels turn forward, and stop?")
            self.wait_for(lambda: board.velocity == (0, 0), START_TIMEOUT, "the robot to stop before its user answers")
            terminal.sendline(answer)
            terminal.expect_exact(result)
