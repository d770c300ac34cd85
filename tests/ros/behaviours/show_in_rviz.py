"""RViz, on a virtual display, shows the robot in motion and its path."""

import os
import subprocess
from pathlib import Path

from PIL import Image

from harness import RobotTest, read

START_RVIZ = 60.0             # seconds, drawing without a graphics card
VIEW = 420, 110, 1020, 700    # left, upper, right and lower edge of the 3D view, in pixels
BACKGROUND = 235, 236, 238    # red, green, blue; as in simulation.rviz
PIXELS = 100                  # fewer may be noise


class RViz(RobotTest):
    def test_shows_the_robot_move(self):
        launch = self.launch("simulation", "simulation.launch", "motion:=true", "linear:=0.3", "angular:=0.1",
                             env={**os.environ, "DISPLAY": self.display(), "LIBGL_ALWAYS_SOFTWARE": "1"})
        self.wait_for(lambda: len(self.pixels(is_background)) > 100000 and len(self.pixels(is_green)) > PIXELS,
                      START_RVIZ, "the robot in RViz")
        first = self.pixels(is_green)
        self.wait_for(lambda: len(first ^ self.pixels(is_green)) > PIXELS, 30.0, "the robot's board to turn")
        self.wait_for(lambda: len(self.pixels(is_orange)) > PIXELS, 5.0, "its path")
        self.assertNotIn("[ERROR]", read(launch))

    def display(self):
        """Return the name of a new X display, which keeps its picture in a file."""
        reading, writing = os.pipe()
        self.start("Xvfb", "-displayfd", str(writing), "-screen", "0", "1100x800x24", "-fbdir", self.folder,
                   pass_fds=[writing])
        os.close(writing)
        with os.fdopen(reading) as number:
            return f":{number.readline().strip()}"

    def pixels(self, is_wanted):
        """Return the indices of the pixels in the 3D view whose (red, green, blue) is wanted.

        They come from the display's file: a request to the display itself would make RViz wait.
        """
        file = Path(self.folder, "screen.png")
        subprocess.run(["convert", f"xwd:{self.folder}/Xvfb_screen0", str(file)], check=True)
        return {i for i, color in enumerate(Image.open(file).convert("RGB").crop(VIEW).getdata()) if is_wanted(*color)}


def is_background(*color):
    return color == BACKGROUND


def is_green(red, green, blue):  # the robot's board
    return green > red + 30 and green > blue + 30


def is_orange(red, green, blue):  # the path
    return red > 180 and red > green + 60 and green > blue
