"""A robot's URDF has the colour of its name."""

import xml.etree.ElementTree as ET

import pytest

from conftest import SIMULATION
from jetbot_ros.colors import color_of
from simulation.description import paint

URDF = (SIMULATION / "urdf/jetbot.urdf").read_text()


@pytest.mark.parametrize("namespace, name", [("red", "red"), ("/jetbot_07/", "jetbot_07"), ("class_7/blue", "blue")])
def test_the_case_has_the_colour_of_the_robot_in_this_namespace(namespace, name):
    [color] = ET.fromstring(paint(URDF, namespace)).findall("material[@name='case']/color")
    assert [float(part) for part in color.get("rgba").split()] == pytest.approx([*color_of(name), 1], abs=0.005)


def test_without_a_name_nothing_changes():
    assert paint(URDF, "") == paint(URDF, "/") == URDF
