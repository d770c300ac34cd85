"""What is typed wins over a file; a node that cannot start logs one sentence, and its exit code is not 0."""

import os

import rospy

from harness import CONTROLLER, START_TIMEOUT, RobotTest, program, read

ERRORS = [  # a sentence, and the parameters that cause it
    ("There is no parameter bord. Do you mean board?", "_bord:=sparkfun"),
    ("A robot cannot be named jetbot-07. Begin with a letter, and use letters, digits and _.",
     "_i2c_bus:=fake", "__ns:=jetbot-07")]


class Launch(RobotTest):
    def test_one_line(self):
        for sentence, *parameters in ERRORS:
            node = self.start(CONTROLLER, *parameters)
            self.assertNotEqual(node.wait(START_TIMEOUT), 0)
            lines = read(node).splitlines()
            self.assertEqual(len(lines), 1, lines)
            self.assertIn(sentence, lines[0])
        self.assert_nothing_left()

    def assert_nothing_left(self):
        self.assertEqual([name for name in rospy.get_param_names() if "/jetbot_" in name], [])

    def test_what_is_typed_ends_with_its_node(self):
        self.start(program("simulation", "simulator.py"), f"_i2c_bus:=fake:{self.bus}", "_x:=1")
        self.controller(max_speed=0.5).kill()
        self.wait_for(lambda: "at x 1.00 m" in self.logs(), START_TIMEOUT, "the simulator")
        self.assert_nothing_left()

    def test_no_master(self):
        nowhere = {**os.environ, "ROS_MASTER_URI": "http://localhost:1"}
        nodes = [self.start(node, env=nowhere) for node in (CONTROLLER, program("simulation", "simulator.py"))]
        sentence = "No ROS master at http://localhost:1. Start one in another terminal: roscore\n"
        for node in nodes:
            self.assertNotEqual(node.wait(START_TIMEOUT), 0)
            self.assertEqual(read(node), sentence)

    def test_roslaunch_ends_when_the_controller_cannot_start(self):
        launch = self.start("roslaunch", "workshop", "workshop_jetbot_controller.launch", "i2c_bus:=77")
        launch.wait(START_TIMEOUT)
        self.assertEqual(read(launch).count("There is no I2C bus /dev/i2c-77."), 1, "no endless respawns")
        self.assertNotIn("Traceback", read(launch))
