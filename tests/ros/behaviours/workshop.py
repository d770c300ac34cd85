"""The workshop's scenario and its own controller scripts, as a class and as functions, drive the wheels."""

import os
import signal
import sys
import time
from pathlib import Path

import rosgraph
import rospy
from geometry_msgs.msg import Twist

from harness import CONTROLLER, START_TIMEOUT, RobotTest, read, wheel_speeds

RUN = Path(__file__).parents[3] / "setup/run.py"  # ./morbot run
LAUNCH = "workshop", "workshop_jetbot_controller.launch"
HEAD = """
import rospy
from geometry_msgs.msg import Twist
from jetbot import Robot
"""

AS_A_CLASS = """
class Listener:
    def __init__(self):
        rospy.init_node('jetbot_controller', anonymous=True)
        self.robot = Robot()
        rospy.Subscriber('/cmd_vel', Twist, self.on_twist)
        rospy.spin()

    def on_twist(self, twist):
        self.robot.set_motors(twist.linear.x - twist.angular.z, twist.linear.x + twist.angular.z)

Listener()
"""

AS_FUNCTIONS = """
def on_twist(twist, robot):
    robot.set_motors(twist.linear.x - twist.angular.z, twist.linear.x + twist.angular.z)

rospy.init_node('jetbot_controller', anonymous=True)
robot = Robot()
rospy.Subscriber('/cmd_vel', Twist, on_twist, callback_args=robot)
rospy.spin()
"""


class Workshop(RobotTest):
    def test_the_scenario_commands_its_motion_ten_times_a_second_and_a_second_start_is_refused(self):
        rospy.set_param("/jetbot_motion_control/linear", 0.2)  # left by an earlier start
        self.launch(*LAUNCH)
        self.wait_for_wheels(0.4, 0.6, within=START_TIMEOUT)
        received = self.record("/cmd_vel", Twist, lambda twist: (time.monotonic(), twist))
        self.wait_for(lambda: len(received) > 20 and abs(20 / (received[-1][0] - received[-21][0]) - 10) < 0.5,
                      START_TIMEOUT, "ten commands a second")
        self.assertEqual({(twist.linear.x, twist.angular.z) for _, twist in received}, {(0.5, 0.1)})
        for second in (self.start(sys.executable, str(RUN), "another", *LAUNCH, "linear:=1.0"),
                       self.start(CONTROLLER, f"_i2c_bus:=fake:{self.bus}_of_another")):
            self.assertNotEqual(second.wait(START_TIMEOUT), 0)
            self.assertIn("The node /jetbot_controller is already running. End it first", read(second))
        namesake = self.start(CONTROLLER, f"_i2c_bus:=fake:{self.bus}", "__name:=other")
        self.assertNotEqual(namesake.wait(START_TIMEOUT), 0)
        self.assertRegex(read(namesake),
                         r"Another program \(jetbot_controller.py, process \d+\) already drives 0x60 on fake:")
        self.wheels_stay(0.4, 0.6, for_seconds=0.3)
        self.assertEqual(rospy.get_param("/jetbot_motion_control/linear"), 0.5)

    def test_its_launch_file_passes_arguments_on_to_both_nodes_and_they_win_over_the_file_and_it_over_the_default(self):
        file = Path(self.folder, "robot.yaml")
        file.write_text("max_speed: 0.5\nleft_motor_alpha: 0.5\n")
        self.launch(*LAUNCH, "robot_name:=red", "board:=waveshare", f"config:={file}", "max_speed:=2.0",
                    "left_motor_alpha:=", "linear:=1.0", "angular:=0.0")
        self.wait_for(lambda: wheel_speeds(self.bus, "waveshare") == (0.25, 0.5), START_TIMEOUT,
                      "the Waveshare board's wheels")
        self.assertEqual(self.wheels(), (0, 0), "and not the Adafruit board's")
        publishers, subscribers, _ = map(dict, rosgraph.Master("/test").getSystemState())
        self.assertEqual(publishers["/red/cmd_vel"], ["/red/jetbot_motion_control"])
        self.assertEqual(subscribers["/red/cmd_vel"], ["/red/jetbot_controller"])

    def test_its_own_controller_scripts_drive_and_their_end_stops_the_wheels(self):
        for script, ending in (AS_A_CLASS, signal.SIGKILL), (AS_FUNCTIONS, signal.SIGHUP):
            environment = {**os.environ, "JETBOT_I2C_BUS": f"fake:{self.bus}"}
            process = self.start(sys.executable, "-c", HEAD + script, env=environment)
            self.wait_for_controller()
            self.command(0.5, 0.1)
            self.wait_for_wheels(0.4, 0.6)
            process.send_signal(ending)
            process.wait(START_TIMEOUT)
            self.wait_for_stop(within=1.5)
            self.wait_for(lambda: not self.commands().get_num_connections(), 5.0, "the script to unsubscribe")
