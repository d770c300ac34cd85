#!/usr/bin/env python3
"""RViz, on a virtual display, shows the robot in motion and its path."""

import os
import subprocess
from pathlib import Path

import rospy
from nav_msgs.msg import Odometry
from PIL import Image

from harness import START_TIMEOUT, RobotTest, main, read

START_RVIZ = 60.0             # seconds, drawing without a graphics card
VIEW = 420, 110, 1020, 700    # left, upper, right and lower edge of the 3D view, in pixels
BACKGROUND = 235, 236, 238    # red, green, blue; as in simulation.rviz
PIXELS = 100                  # fewer may be noise


class RViz(RobotTest):
    def setUp(self):
        super().setUp()
        self.yaw = None
        self.addCleanup(rospy.Subscriber("odom", Odometry, self.keep_yaw).unregister)

    def keep_yaw(self, odometry):
        self.yaw = odometry.pose.pose.orientation.z

    def test_shows_the_robot_move(self):
        launch = self.launch("simulation", "simulation.launch", "motion:=true", "linear:=0.3", "angular:=0.1",
                             env={**os.environ, "DISPLAY": self.display(), "LIBGL_ALWAYS_SOFTWARE": "1"})
        self.wait_for(lambda: self.yaw is not None, START_TIMEOUT, "odometry")
        self.wait_for(lambda: shows_a_robot(self.screenshot()), START_RVIZ, "the robot in RViz")
        first, yaw = green(self.screenshot()), self.yaw
        self.wait_for(lambda: abs(self.yaw - yaw) > 0.2, 30.0, "the robot to turn")
        self.wait_for(lambda: len(orange(self.screenshot())) > PIXELS, 5.0, "its path")
        self.assertGreater(len(first ^ green(self.screenshot())), PIXELS, "the board has not turned")
        self.assertNotIn("[ERROR]", read(launch))

    def display(self):
        """Return the name of a new X display, which keeps its picture in a file."""
        reading, writing = os.pipe()
        self.start("Xvfb", "-displayfd", str(writing), "-screen", "0", "1100x800x24", "-fbdir", self.folder,
                   pass_fds=[writing])
        os.close(writing)
        with os.fdopen(reading) as number:
            return f":{number.readline().strip()}"

    def screenshot(self):
        """Return what the display shows, from its file: a request to the display itself would make RViz wait."""
        file = Path(self.folder, "screen.png")
        subprocess.run(["convert", f"xwd:{self.folder}/Xvfb_screen0", str(file)], check=True)
        return Image.open(file).convert("RGB")


def pixels(image, is_wanted):
    """Return the indices of the pixels whose (red, green, blue) is wanted."""
    return {i for i, colour in enumerate(image.getdata()) if is_wanted(*colour)}


def shows_a_robot(image):
    """Return whether the image has the 3D view, with its light background, and a robot's board in it."""
    return len(pixels(image.crop(VIEW), lambda *colour: colour == BACKGROUND)) > 100000 and len(green(image)) > PIXELS


def green(image):
    """Return the pixels of the robot's board."""
    return pixels(image.crop(VIEW), lambda r, g, b: g > r + 30 and g > b + 30)


def orange(image):
    """Return the pixels of the path."""
    return pixels(image.crop(VIEW), lambda r, g, b: r > 180 and r > g + 60 and g > b)


if __name__ == "__main__":
    main(RViz)
