"""A robot's URDF has the colour of its name, and its camera where the pictures have it."""

import math
import xml.etree.ElementTree as ET

import pytest

from conftest import SIMULATION
from jetbot.camera import lens
from jetbot_ros.colors import color_of
from simulation.description import paint

URDF = (SIMULATION / "urdf/jetbot.urdf").read_text()


@pytest.mark.parametrize("namespace, name", [("red", "red"), ("/jetbot_07/", "jetbot_07"), ("class_7/blue", "blue")])
def test_the_case_has_the_colour_of_the_robot_in_this_namespace(namespace, name):
    [color] = ET.fromstring(paint(URDF, namespace)).findall("material[@name='case']/color")
    assert [float(part) for part in color.get("rgba").split()] == pytest.approx([*color_of(name), 1], abs=0.005)


def test_without_a_name_nothing_changes():
    assert paint(URDF, "") == paint(URDF, "/") == URDF


def test_the_camera_is_where_the_pictures_have_it():
    x, z, pitch = 0.0, 0.0, 0.0
    for name in ("base", "camera_mast", "camera"):
        assert pitch == 0, "the offsets add up above a level joint alone"
        origin = ET.fromstring(URDF).find(f"joint[@name='{name}_joint']/origin")
        (ahead, _, up), pitch = map(float, origin.get("xyz").split()), float(origin.get("rpy", "0 0 0").split()[1])
        x, z = x + ahead, z + up
    assert (x, z, math.degrees(pitch)) == pytest.approx((lens.AHEAD, lens.HEIGHT, lens.TILT), abs=1e-3)
