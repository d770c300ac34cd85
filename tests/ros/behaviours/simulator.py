"""The simulated robot drives as the registers on the fake bus command, along the arc of the velocity."""

import math
import signal
from pathlib import Path

import rospy
from geometry_msgs.msg import Pose2D
from nav_msgs.msg import Odometry
from std_srvs.srv import Empty

from harness import START_TIMEOUT, RobotTest, program, publishers, read
from jetbot import Robot
from simulation.recording import pose_of

WHEEL_SEPARATION = 0.1125  # m


class Simulator(RobotTest):
    def setUp(self):
        super().setUp()
        self.simulator = self.start(program("simulation", "simulator.py"), f"_i2c_bus:=fake:{self.bus}",
                                    "_motor_lag:=0.05", "_x:=1", "_yaw:=0.5")
        self.samples = self.record("odom", Odometry)
        self.wait_for(lambda: self.samples, START_TIMEOUT, "odometry")

    def robot(self, **options):
        """Return a robot that this process drives."""
        return Robot("adafruit", f"fake:{self.bus}", **options)

    def velocity(self):
        twist = self.samples[-1].twist.twist
        return twist.linear.x, twist.angular.z

    def wait_for_velocity(self, linear, angular):
        self.wait_for(lambda: abs(self.velocity()[0] - linear) < 0.001 and abs(self.velocity()[1] - angular) < 0.01,
                      5.0, f"{linear} m/s and {angular} rad/s")

    def wait_for_pose(self, *pose):
        self.wait_for(lambda: tuple(round(value, 2) for value in pose_of(self.samples[-1])) == pose, 5.0, f"{pose}")

    def sample_after(self, seconds):
        """Return the newest pose, the first that is this many seconds later, and the seconds between them."""
        first = self.samples[-1]
        self.wait_for(lambda: elapsed(first, self.samples[-1]) >= seconds, seconds + 5, "odometry")
        last = self.samples[-1]
        return pose_of(first), pose_of(last), elapsed(first, last)

    def test_drives_the_arc_of_the_command(self):
        self.controller(cmd_vel_timeout=0, wheel_separation=WHEEL_SEPARATION, max_speed=0.6)
        for linear, angular in [(0.4, 0.0), (0.3, 1.0), (0.0, -2.0)]:
            self.command(linear, angular)
            self.wait_for_velocity(linear, angular)
            first, last, seconds = self.sample_after(1.0)
            arc, turn = linear * seconds, angular * seconds
            wanted = first.integrate_arc(arc - turn * WHEEL_SEPARATION / 2, arc + turn * WHEEL_SEPARATION / 2,
                                         WHEEL_SEPARATION)
            self.assertLess(distance(last, wanted), 0.01 * max(arc, 0.1))
            self.assertLess(abs(math.remainder(last.yaw - wanted.yaw, math.tau)), 0.01 * max(abs(turn), 0.1))

    def test_a_driver_with_swapped_wheels_turns_it_the_other_way(self):
        with self.robot() as robot:
            robot.set_motors(0.4, 0.6)
            self.wait_for(lambda: self.velocity()[1] > 0.5, 5.0, "a turn to the left")
        with self.robot(swap_motors=True) as robot:
            robot.set_motors(0.4, 0.6)
            self.wait_for(lambda: self.velocity()[1] < -0.5, 5.0, "a turn to the right")

    def test_is_placed_and_reset(self):
        place = rospy.Publisher("jetbot_simulator/set_pose", Pose2D, queue_size=1)
        self.addCleanup(place.unregister)
        self.wait_for(place.get_num_connections, START_TIMEOUT, "the simulator to subscribe")
        place.publish(2.0, -3.0, 1.0)
        self.wait_for_pose(2.0, -3.0, 1.0)
        warning = "A pose must be finite, and within 1000 m. The robot stays where it is."
        for number, y in enumerate((math.nan, 1e308), 1):
            place.publish(0.0, y, 0.0)
            self.wait_for(lambda number=number: self.logs().count(warning) == number, 5.0, warning)
        self.sample_after(0.1)
        self.wait_for_pose(2.0, -3.0, 1.0)
        rospy.ServiceProxy("jetbot_simulator/reset", Empty)()
        self.wait_for_pose(1.0, 0.0, 0.5)

    def test_prints_its_state_when_it_changes(self):
        self.wait_for(lambda: read(self.simulator), START_TIMEOUT, "a line")
        self.sample_after(1.2)
        self.assertEqual(read(self.simulator), "at x 1.00 m, y 0.00 m, heading 29 deg; "
                                               "left wheel 0.00 m/s, right wheel 0.00 m/s\n")
        with self.robot() as robot:
            robot.set_motors(0.5, 0.5)
            self.wait_for(lambda: "left wheel 0.30 m/s, right wheel 0.30 m/s" in read(self.simulator), 5.0, "a line")
        self.wait_for(lambda: read(self.simulator).endswith("left wheel 0.00 m/s, right wheel 0.00 m/s\n"), 5.0,
                      "a last line")
        self.assertRegex(read(self.simulator).splitlines()[-1], r"^at x 1\.\d\d m, y 0\.\d\d m, heading 29 deg; ")

    def test_says_once_why_a_wheel_does_not_turn(self):
        sentence = "the wheels get 4.7 % of full power, too little to turn: raise min_duty, or lower pwm_frequency"
        with self.robot() as robot:
            robot.set_motors(0.047, -0.047)
            self.wait_for(lambda: sentence in read(self.simulator), 5.0, "the sentence")
            self.sample_after(1.0)
            self.assertEqual(self.velocity(), (0, 0))
            robot.set_motors(0.06, -0.06)
            self.wait_for(lambda: self.velocity()[1] < -0.05, 5.0, "a slow turn")
        self.assertEqual(read(self.simulator).count(sentence), 1)

    def test_a_controller_that_publishes_odom_takes_over_and_its_last_odometry_is_a_stop(self):
        controller = self.controller(publish_odom=True, cmd_vel_timeout=0)
        for topic in ("/odom", "/joint_states"):
            self.wait_for(lambda topic=topic: publishers(topic) == ["/jetbot_controller"], START_TIMEOUT, topic)
        warning = "odom is not in metres: add config:=si_units.yaml"
        self.wait_for(lambda: warning in self.logs(), START_TIMEOUT, warning)
        self.command(0.5)
        self.wait_for_velocity(0.5, 0.0)  # in the workshop's units, not those of the simulated robot
        controller.send_signal(signal.SIGINT)
        self.wait_for_velocity(0.0, 0.0)

    def test_its_track_is_drawn_at_ctrl_c(self):
        picture = Path(self.folder, "track.png")
        process = self.start(program("simulation", "draw_track.py"), str(picture))
        self.wait_for(self.commands().get_num_connections, START_TIMEOUT, "draw_track.py to subscribe")
        self.sample_after(0.5)
        self.assertEqual(read(process), "Recording /odom for 20 s; Ctrl-C ends earlier and draws what there is.\n")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(START_TIMEOUT), 0, read(process))
        self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")


def elapsed(first, last):
    return (last.header.stamp - first.header.stamp).to_sec()


def distance(pose, other):
    return math.hypot(pose.x - other.x, pose.y - other.y)
