"""A robot with unequal wheels and another wheel separation: two rounds of squares make it drive them closed."""

import math
from pathlib import Path

import rospy
from geometry_msgs.msg import Pose2D
from nav_msgs.msg import Odometry

from behaviours.calibration import CalibrationTest
from harness import START_TIMEOUT, program
from jetbot.fake.motors import STOPPED
from jetbot_control_node.parameters import load

# A JetBot at 12 V, which is fast, with a right wheel 3 % smaller and wheels 8 % further apart than NVIDIA's model.
BODY = {"wheel_separation": 0.1215, "wheel_ratio": 0.97, "max_speed": 1.2}


class CalibrationSquares(CalibrationTest):
    def setUp(self):
        super().setUp()
        body = Path(self.folder, "body.yaml")
        body.write_text("".join(f"{name}: {value}\n" for name, value in BODY.items()))
        self.start(program("simulation", "simulator.py"), f"_i2c_bus:=fake:{self.bus}", f"_body:={body}")
        self.states = self.record("odom", Odometry)
        self.place = rospy.Publisher("/jetbot_simulator/set_pose", Pose2D, queue_size=1)
        self.addCleanup(self.place.unregister)
        self.wait_for(lambda: self.states and self.place.get_num_connections(), START_TIMEOUT, "the simulator")

    def position(self):
        """Return where the robot is: cm ahead of the start, cm left of it."""
        position = self.states[-1].pose.pose.position
        return 100 * position.x, 100 * position.y

    def wait_for_rest(self):
        def rests():
            velocity = self.states[-1].twist.twist
            return abs(velocity.linear.x) + abs(velocity.angular.z) < 1e-4
        self.wait_for(rests, 9.0, "the robot to rest")

    def run_motion(self, announcement):
        """Put the robot at the start, let it drive, and return where it comes to rest."""
        self.wait_for_rest()
        self.place.publish(Pose2D())
        self.wait_for(lambda: math.hypot(*self.position()) < 0.1, START_TIMEOUT, "the robot to be at the start")
        self.answer(announcement)
        self.terminal.expect("How many centimetres", timeout=START_TIMEOUT)
        self.wait_for_rest()
        return self.position()

    def tell(self, value, sides):
        self.terminal.sendline(f"{abs(value):.0f} cm")
        if round(value):
            self.answer(" or ", sides[value < 0])

    def run_square(self, side):
        """Drive a square and tell where it ends; return how many cm from the start."""
        ahead, left = self.run_motion(f"a square to the {side}")
        self.tell(ahead, ("ahead", "behind"))
        self.terminal.expect("How many centimetres to the left")
        self.tell(left, ("left", "right"))
        return math.hypot(ahead, left)

    def from_the_box_to_the_floor(self):
        for wheel in ("left", "right"):
            self.drive("output will turn one wheel")
            self.terminal.sendline(wheel)
            self.answer("Forward or backward", "forward")
        self.answer("Put the robot on the floor")
        for _ in ("left", "right"):
            self.answer("press a key as soon as it turns")
            self.wait_for(lambda: self.wheels() != STOPPED and max(self.wheels()) > 0.006, START_TIMEOUT, "a wheel")
            self.terminal.send("x")
            self.answer("Did the .* wheel turn", "y")
        self.drive("drive ahead for 4 s")
        self.terminal.sendline("")  # straight enough

    def test_two_rounds_close_the_squares(self):
        self.from_the_box_to_the_floor()
        self.answer("Measure how far it drives", "y")
        self.terminal.sendline(f"{math.hypot(*self.run_motion('drive ahead for 2 s')):.0f}")
        self.answer("Measure how far it turns")  # Enter alone skips it
        misses = []
        while len(misses) < 3 or misses[-1] > 5 and len(misses) < 5:  # a step that is 10 ms late costs 4 cm
            self.answer("Drive the squares", "y")
            misses.append(max(self.run_square("left"), self.run_square("right")))
        self.answer("Drive the squares again")
        self.terminal.expect("linear.x is in m/s, angular.z in rad/s")
        self.terminal.expect("To undo it")
        self.assertGreater(misses[0], 50, "cm, before the first correction")
        self.assertLess(misses[-1], 5, "cm, after the second one, or two more on a busy computer")
        calibrated = load(self.file)
        self.assertAlmostEqual(calibrated["wheel_separation"], BODY["wheel_separation"], delta=0.004)
        self.assertAlmostEqual(calibrated["left_motor_alpha"], 0.97, delta=0.01)
        self.assertEqual(calibrated["pwm_frequency"], 50)
