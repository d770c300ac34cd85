"""simulation.launch: the robot has the controller's board and units; one node publishes odom, one sends its tf."""

import math
import os
import pathlib
import shutil

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from PIL import Image, ImageChops
from tf2_msgs.msg import TFMessage
from tf2_ros import Buffer, TransformListener

from harness import START_TIMEOUT, RobotTest, publishers, twist
from jetbot.wait import wait_until
from processes import start_display

ROBOTS = {"red": (0.5, 0.3, 0.0), "green": (0.0, 0.0, 0.1), "blue": (-0.5, -0.3, -0.5)}  # y in m; m/s, rad/s
START_RVIZ = 60.0             # seconds, drawing without a graphics card
LOOK_INTERVAL = 0.1           # seconds
VIEW = 420, 110, 1020, 700    # left, upper, right and lower edge of the 3D view, in pixels
VIEW_SIZE = 600, 590
PIXELS = 100                  # fewer may be noise
SCREEN = 1100, 800            # pixels of 4 bytes: blue, green, red and nothing


class SimulationLaunch(RobotTest):
    def simulate(self, *arguments, rviz="false", **options):
        """Start simulation.launch with a robot at x = 1 m, and wait until it is known where it is."""
        self.odometry, self.transforms = self.record("odom", Odometry), self.record("/tf", TFMessage)
        self.frames = Buffer()
        self.addCleanup(TransformListener(self.frames).unregister)
        self.launch("simulation", "simulation.launch", f"port:=fake:{self.bus}", f"rviz:={rviz}", "x:=1",
                    "publish_odom:=true", *arguments, **options)
        self.wait_for_controller()
        self.wait_for(lambda: self.is_where_odometry_says(0.01), START_TIMEOUT, "its start")

    def is_where_odometry_says(self, distance):
        return near(self.frames, "base_footprint", "true_base_footprint", distance)

    def assert_drives(self, command, velocity):
        """Repeat the command until odom has this velocity in m/s and rad/s."""
        def driving():
            self.command(*command)
            return self.odometry and is_moving(self.odometry[-1], *velocity)
        self.wait_for(driving, START_TIMEOUT, f"a velocity of {velocity}")

    def assert_one_odometry(self, joint_states, command):
        """Drive, and fail unless the controller alone publishes odom and its tf, and this one those of the wheels."""
        self.assert_drives(command, command)
        self.wait_for(lambda: self.command(*command) or self.odometry[-1].pose.pose.position.y > 0.2, START_TIMEOUT,
                      "a part of a circle")
        self.command(0)
        self.wait_for(lambda: self.odometry[-1].twist.twist.linear.x == 0, START_TIMEOUT, "the end of the motion")
        self.wait_for(lambda: self.is_where_odometry_says(0.1), 5.0, "the robot to arrive")
        self.assertEqual(publishers("/odom"), ["/jetbot_controller"])
        self.assertEqual(publishers("/joint_states"), [joint_states])
        self.assertEqual(senders(self.transforms, "base_footprint"), {"/jetbot_controller"})
        self.assertEqual(senders(self.transforms, "true_base_footprint"), {"/jetbot_simulator"})

    def test_open_loop_odometry_of_a_configured_board_ends_where_the_robot_does_and_rviz_shows_that(self):
        config = pathlib.Path(self.folder, "robot.yaml")
        config.write_text("board: waveshare_hat\ni2c_address: 0x61\nwheel_separation: 0.1125\nmax_speed: 0.6")
        if not all(map(shutil.which, ("rviz", "Xvfb"))):
            self.simulate(f"config:={config}")
            self.assert_one_odometry("/jetbot_controller", (0.4, 0.5))
            self.skipTest("sudo apt install rviz xvfb libgl1-mesa-dri")
        self.simulate(f"config:={config}", rviz="true",
                      env={**os.environ, "DISPLAY": self.display(), "LIBGL_ALWAYS_SOFTWARE": "1"})
        self.wait_for_picture(Image.new("L", VIEW_SIZE), "the robot in RViz")
        before = self.green_pixels()
        self.assert_one_odometry("/jetbot_controller", (0.4, 0.5))
        self.wait_for_picture(before, "the robot's board to move")
        self.assertNotIn("[ERROR]", self.logs())

    def test_the_odometry_of_a_jetbot_pro_is_the_only_one_and_ends_where_the_robot_does(self):
        self.simulate("board:=jetbot_pro")
        self.assert_one_odometry("/jetbot_simulator", (1.0, 0.5))

    def test_three_robots_share_a_map_and_each_obeys_its_own_commands_in_si_units(self):
        odometry = {name: self.record(f"/{name}/odom", Odometry) for name in ROBOTS}
        commands = {name: rospy.Publisher(f"/{name}/cmd_vel", Twist, queue_size=1) for name in ROBOTS}
        frames = Buffer()
        self.addCleanup(TransformListener(frames).unregister)
        self.start("roslaunch", "simulation", "three_robots.launch", "rviz:=false", "config:=si_units.yaml",
                   env={**os.environ, "ROS_HOME": os.path.join(self.folder, "home")})
        for name, (y, _, _) in ROBOTS.items():
            self.wait_for(lambda name=name: frames.can_transform("map", f"{name}/left_wheel", rospy.Time()),
                          START_TIMEOUT, f"{name} on the map")
            where = frames.lookup_transform("map", f"{name}/base_link", rospy.Time()).transform.translation
            self.assertEqual((where.x, where.y, where.z), (0, y, 0.03))
        self.assertEqual(len({rospy.get_param(f"/{name}/robot_description") for name in ROBOTS}), 3, "colours")

        def driving():
            for name, (_, *velocity) in ROBOTS.items():
                commands[name].publish(twist(*velocity))
            return all(odometry[name] and is_moving(odometry[name][-1], *velocity)
                       for name, (_, *velocity) in ROBOTS.items())

        self.wait_for(driving, START_TIMEOUT, "each robot's own velocity")

    def wait_for_picture(self, other, what):
        """Fail unless the picture soon differs from the other one in enough pixels."""
        self.assertTrue(wait_until(lambda: ImageChops.difference(other, self.green_pixels()).histogram()[255] > PIXELS,
                                   START_RVIZ, LOOK_INTERVAL), f"waited for {what}{self.logs()}")

    def display(self):
        """Return the name of a new X display, which keeps its picture in a file."""
        process, name = start_display(pathlib.Path(self.folder, "display"), "-screen", "0",
                                      "{}x{}x24".format(*SCREEN), "-fbdir", self.folder)
        self.processes.append(process)
        return name

    def green_pixels(self):
        """Return a picture of the 3D view that is white where it shows the robot's board, which is green, else black.

        It comes from the display's file: a request to the display itself would make RViz wait.
        """
        file = pathlib.Path(self.folder, "Xvfb_screen0").read_bytes()  # ends with the pixels: xwd(1)
        screen = Image.frombytes("RGB", SCREEN, file[-4 * SCREEN[0] * SCREEN[1]:], "raw", "BGRX")
        red, green, blue = screen.crop(VIEW).split()
        excess = ImageChops.subtract(green, ImageChops.lighter(red, blue), offset=-30)
        return excess.point(lambda value: 255 * (value > 0))


def is_moving(odometry, linear, angular):
    """Return whether this is the odometry of a robot with this velocity in m/s and rad/s."""
    velocity = odometry.twist.twist
    return math.hypot(velocity.linear.x - linear, velocity.angular.z - angular) < 0.02


def senders(transforms, child):
    """Return the names of the nodes that send this frame's transform."""
    return {message._connection_header["callerid"] for message in transforms
            if message.transforms[0].child_frame_id == child}


def near(frames, frame, other, distance):
    """Return whether the two frames are at most this many metres apart."""
    if not frames.can_transform(frame, other, rospy.Time()):
        return False
    between = frames.lookup_transform(frame, other, rospy.Time()).transform.translation
    return math.hypot(between.x, between.y) < distance
