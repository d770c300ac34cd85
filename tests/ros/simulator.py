#!/usr/bin/env python3
"""The simulated robot drives as the registers on the fake bus command, along the arc of the velocity."""

import math
import os
from functools import partial
from pathlib import Path
from unittest import mock

import rosbag
import rospy
from geometry_msgs.msg import Pose2D, Twist
from nav_msgs.msg import Odometry
from std_srvs.srv import Empty

from harness import CONTROLLER, START_TIMEOUT, RobotTest, main, program, read, twist
from jetbot import Robot, boards
from jetbot.boards.pwm_motors import ADAFRUIT, PwmMotors, Wiring
from jetbot.fake.bus import FakeBus

NAMESPACE = "simulated"  # of the simulator that each test starts
MODE1, SLEEP = 0x00, 0x10
LONG_ENOUGH = 1.0  # seconds between two samples of the odometry


class Simulator(RobotTest):
    def setUp(self):
        super().setUp()
        self.environment = {**os.environ, "ROS_NAMESPACE": NAMESPACE}
        self.start(program("simulation", "simulator.py"), f"_i2c_bus:=fake:{self.bus}", "_motor_lag:=0.05", "_x:=1",
                   "_yaw:=0.5", env=self.environment)
        self.samples = []
        self.addCleanup(rospy.Subscriber(f"{NAMESPACE}/odom", Odometry, self.samples.append).unregister)
        self.wait_for(lambda: self.samples, START_TIMEOUT, "odometry")
        self.wait_for_velocity(0, 0)

    def robot(self):
        """Return a robot that this process drives."""
        return Robot("adafruit", f"fake:{self.bus}")

    def wait_for_velocity(self, linear, angular):
        self.wait_for(lambda: abs(self.velocity()[0] - linear) < 0.001 and abs(self.velocity()[1] - angular) < 0.01,
                      5.0, f"{linear} m/s and {angular} rad/s")

    def velocity(self):
        twist = self.samples[-1].twist.twist
        return twist.linear.x, twist.angular.z

    def position(self):
        """Return x, y and heading, rounded to 0.01 m and rad."""
        sample = self.samples[-1]
        position = sample.pose.pose.position
        return round(position.x, 2), round(position.y, 2), round(heading(sample), 2)

    def sample_after(self, seconds):
        """Return the newest sample now, and the first that is so many seconds later."""
        first = self.samples[-1]
        self.wait_for(lambda: elapsed(first, self.samples[-1]) >= seconds, seconds + 5, "odometry")
        return first, self.samples[-1]

    def test_drives_the_arc_of_the_command(self):
        self.start(CONTROLLER, f"_i2c_bus:=fake:{self.bus}", "_cmd_vel_timeout:=0", "_wheel_separation:=0.1125",
                   "_max_speed:=0.6", env=self.environment)
        commands = rospy.Publisher(f"{NAMESPACE}/cmd_vel", Twist, queue_size=1, latch=True)
        self.addCleanup(commands.unregister)
        self.wait_for(commands.get_num_connections, START_TIMEOUT, "the controller to subscribe")
        for linear, angular in [(0.4, 0.0), (0.3, 1.0), (0.0, -2.0)]:
            with self.subTest(linear=linear, angular=angular):
                commands.publish(twist(linear, angular))
                self.wait_for_velocity(linear, angular)
                first, last = self.sample_after(LONG_ENOUGH)
                seconds = elapsed(first, last)
                x, y, turn = motion(first, last)
                wanted_x, wanted_y = arc(linear, angular, seconds)
                self.assertLess(math.hypot(x - wanted_x, y - wanted_y), 0.01 * max(linear * seconds, 0.1))
                self.assertLess(abs(turn - angular * seconds), 0.01 * max(abs(angular) * seconds, 0.1))

    def test_a_driver_with_swapped_wheels_turns_it_the_other_way(self):
        with self.robot() as robot:
            robot.set_motors(0.4, 0.6)
            self.wait_for(lambda: self.velocity()[1] > 0.5, 5.0, "a turn to the left")
        left, right = ADAFRUIT
        swapped = boards.Board(partial(PwmMotors, wirings=(Wiring(left=right, right=left),)), 0x60)
        with mock.patch.dict(boards.BOARDS, adafruit=swapped), self.robot() as robot:
            robot.set_motors(0.4, 0.6)
            self.wait_for(lambda: self.velocity()[1] < -0.5, 5.0, "a turn to the right")

    def test_a_sleeping_chip_does_not_move_it(self):
        chip = FakeBus(self.bus)
        with self.robot() as robot:
            robot.set_motors(0.5, 0.5)
            self.wait_for_velocity(0.3, 0)
            awake = chip.read_byte_data(0x60, MODE1)
            chip.write_byte_data(0x60, MODE1, awake | SLEEP)
            self.wait_for_velocity(0, 0)
            self.assertLess(math.hypot(*motion(*self.sample_after(0.5))), 0.001)
            chip.write_byte_data(0x60, MODE1, awake)
            self.wait_for_velocity(0.3, 0)

    def test_is_placed_and_reset(self):
        place = rospy.Publisher(f"{NAMESPACE}/jetbot_simulator/set_pose", Pose2D, queue_size=1)
        self.addCleanup(place.unregister)
        self.wait_for(place.get_num_connections, START_TIMEOUT, "the simulator to subscribe")
        place.publish(2.0, -3.0, 1.0)
        self.wait_for(lambda: self.position() == (2.0, -3.0, 1.0), 5.0, "the new pose")
        place.publish(0.0, math.nan, 0.0)
        self.sample_after(0.1)
        self.assertEqual(self.position(), (2.0, -3.0, 1.0), "a pose that is not finite is ignored")
        rospy.ServiceProxy(f"{NAMESPACE}/jetbot_simulator/reset", Empty)()
        self.wait_for(lambda: self.position() == (1.0, 0.0, 0.5), 5.0, "the first pose")

    def test_prints_its_state_when_it_changes(self):
        process = self.start(program("simulation", "simulator.py"), f"_i2c_bus:=fake:{self.bus}", "_motor_lag:=0")
        self.wait_for(lambda: read(process).startswith("at x 0.00 m, y 0.00 m, heading 0 deg; "), START_TIMEOUT,
                      "a line")
        self.sample_after(1.2)
        self.assertEqual(len(read(process).splitlines()), 1, "its state has not changed")
        with self.robot() as robot:
            robot.set_motors(0.5, 0.5)
            self.wait_for(lambda: "left wheel 0.30 m/s, right wheel 0.30 m/s" in read(process), START_TIMEOUT, "a line")
        self.wait_for(lambda: read(process).endswith("left wheel 0.00 m/s, right wheel 0.00 m/s\n"), 5.0, "a last line")
        self.assertRegex(read(process).splitlines()[-1], r"^at x 0\.\d\d m, y 0\.00 m, heading 0 deg; ")

    def test_its_track_is_drawn(self):
        live = self.draw("live.png", "--robot", NAMESPACE, "--seconds", "0.3")
        bag = os.path.join(self.folder, "drive.bag")
        with self.robot() as robot, rosbag.Bag(bag, "w") as file:
            robot.set_motors(0.4, 0.6)
            self.wait_for(lambda: self.velocity()[0] > 0.25, 5.0, "speed")
            for sample in list(self.samples):
                file.write("odom", sample, sample.header.stamp)
            file.write("/cmd_vel", Twist(), self.samples[0].header.stamp)
        recorded = self.draw("recorded.png", "--bag", bag)
        for process in live, recorded:
            self.assertEqual(process.wait(START_TIMEOUT), 0, read(process))
            self.assertEqual(Path(process.args[-1]).read_bytes()[:4], b"\x89PNG")

    def draw(self, name, *arguments):
        """Start draw_track.py with a picture of this name."""
        return self.start(program("simulation", "draw_track.py"), *arguments, os.path.join(self.folder, name))


def heading(sample):
    orientation = sample.pose.pose.orientation
    return 2 * math.atan2(orientation.z, orientation.w)


def elapsed(first, last):
    return (last.header.stamp - first.header.stamp).to_sec()


def motion(first, last):
    """Return the motion from one sample to another in the robot's frame at the first: (x in m, y in m, yaw in rad)."""
    start, end, yaw = first.pose.pose.position, last.pose.pose.position, heading(first)
    x, y = end.x - start.x, end.y - start.y
    turn = math.remainder(heading(last) - yaw, 2 * math.pi)
    return x * math.cos(yaw) + y * math.sin(yaw), y * math.cos(yaw) - x * math.sin(yaw), turn


def arc(linear, angular, seconds):
    """Return (x, y) in m after a constant velocity, in closed form."""
    if not angular:
        return linear * seconds, 0.0
    return linear / angular * math.sin(angular * seconds), linear / angular * (1 - math.cos(angular * seconds))


if __name__ == "__main__":
    main(Simulator)
