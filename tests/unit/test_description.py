"""A robot's colour is that of its name, and its camera is where the pictures have it."""

import math
import xml.etree.ElementTree as ET
from itertools import combinations

import pytest

from conftest import SIMULATION
from jetbot.camera import lens
from jetbot_ros.colors import color_of
from simulation.description import paint

URDF = (SIMULATION / "urdf/jetbot.urdf").read_text()
CLASS = [f"jetbot_{number:02}" for number in range(1, 100)]


def test_the_robots_of_a_class_have_different_colours_and_the_first_ones_differ_most():
    assert len({color_of(name) for name in CLASS}) == len(CLASS)
    for color, other in combinations(map(color_of, CLASS[:16]), 2):
        assert max(abs(part - another) for part, another in zip(color, other)) > 0.15


def test_a_robot_without_a_name_is_not_as_red_as_the_cockpits_stop():
    red, green, blue = color_of("")
    assert blue > max(red, green)


@pytest.mark.parametrize("namespace, name", [("red", "red"), ("/jetbot_07/", "jetbot_07"), ("class_7/blue", "blue")])
def test_the_case_has_the_colour_of_the_robot_in_this_namespace(namespace, name):
    [color] = ET.fromstring(paint(URDF, namespace)).findall("material[@name='case']/color")
    assert [float(part) for part in color.get("rgba").split()] == pytest.approx([*color_of(name), 1], abs=0.005)
    assert paint(URDF, "") == paint(URDF, "/") == URDF


def test_the_camera_is_where_the_pictures_have_it():
    x, z, pitch = 0.0, 0.0, 0.0
    for name in ("base", "camera_mast", "camera"):
        assert pitch == 0, "the offsets add up above a level joint alone"
        origin = ET.fromstring(URDF).find(f"joint[@name='{name}_joint']/origin")
        (ahead, _, up), pitch = map(float, origin.get("xyz").split()), float(origin.get("rpy", "0 0 0").split()[1])
        x, z = x + ahead, z + up
    assert (x, z, math.degrees(pitch)) == pytest.approx((lens.AHEAD, lens.HEIGHT, lens.TILT), abs=1e-3)
