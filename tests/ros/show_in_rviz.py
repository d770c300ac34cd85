#!/usr/bin/env python3
"""RViz, on a display without a screen, shows the robot and its path, and the robot moves."""

import os
import subprocess
from pathlib import Path

import rospy
from nav_msgs.msg import Odometry
from PIL import Image

from harness import START, RobotTest, main, read

START_RVIZ = 60.0             # seconds, drawing without a graphics card
VIEW = 420, 110, 1020, 700    # left, upper, right and lower edge of the 3D view, in pixels
BACKGROUND = 235, 236, 238    # red, green, blue; as in simulation.rviz
PIXELS = 100                  # fewer may be chance


class RViz(RobotTest):
    def setUp(self):
        super().setUp()
        self.yaw = None
        self.addCleanup(rospy.Subscriber("odom", Odometry, self.keep_yaw).unregister)

    def keep_yaw(self, odometry):
        self.yaw = odometry.pose.pose.orientation.z

    def test_shows_the_robot_move(self):
        launch = self.launch("simulation", "simulation.launch", "motion:=true", "linear:=0.3", "angular:=1",
                             env={**os.environ, "DISPLAY": self.display(), "LIBGL_ALWAYS_SOFTWARE": "1"})
        self.wait_for(lambda: self.yaw is not None, START, "odometry")
        self.wait_for(lambda: shows_a_robot(self.screenshot()), START_RVIZ, "the robot in RViz")
        first, yaw = green(self.screenshot()), self.yaw
        self.wait_for(lambda: abs(self.yaw - yaw) > 0.2, 30.0, "the robot to turn")
        self.wait_for(lambda: len(orange(self.screenshot())) > PIXELS, 5.0, "its path")
        self.assertGreater(len(first ^ green(self.screenshot())), PIXELS, "the board is where it was")
        self.assertNotIn("[ERROR]", read(launch))

    def display(self):
        """The name of a new X display, which keeps its picture in a file."""
        reading, writing = os.pipe()
        self.start("Xvfb", "-displayfd", str(writing), "-screen", "0", "1100x800x24", "-fbdir", self.folder,
                   pass_fds=[writing])
        os.close(writing)
        with os.fdopen(reading) as number:
            return f":{number.readline().strip()}"

    def screenshot(self):
        """What the display shows, from its file: who asks the display itself makes RViz wait."""
        file = Path(self.folder, "screen.png")
        subprocess.run(["convert", f"xwd:{self.folder}/Xvfb_screen0", str(file)], check=True)
        return Image.open(file).convert("RGB")


def places(image, is_wanted):
    """The places of the pixels whose (red, green, blue) is wanted."""
    return {i for i, colour in enumerate(image.getdata()) if is_wanted(*colour)}


def shows_a_robot(image):
    """Whether the 3D view is there, with its light background, and a robot's board in it."""
    return len(places(image.crop(VIEW), lambda *colour: colour == BACKGROUND)) > 100000 and len(green(image)) > PIXELS


def green(image):
    """Where the robot's board is."""
    return places(image.crop(VIEW), lambda r, g, b: g > r + 30 and g > b + 30)


def orange(image):
    """Where the path is."""
    return places(image.crop(VIEW), lambda r, g, b: r > 180 and r > g + 60 and g > b)


if __name__ == "__main__":
    main(RViz)
