"""A robot's URDF has the colour that its name says."""

import xml.etree.ElementTree as ET

import pytest

from conftest import SIMULATION
from simulation.description import paint

URDF = (SIMULATION / "urdf/jetbot.urdf").read_text()


def case(namespace):
    """Return the colour of the case (red, green, blue) of the robot in this namespace."""
    [color] = ET.fromstring(paint(URDF, namespace)).findall("material[@name='case']/color")
    return tuple(map(float, color.get("rgba").split()[:3]))


@pytest.mark.parametrize("namespace, component", [("red", 0), ("/green/", 1), ("class_7/blue", 2)])
def test_a_colour_in_the_name(namespace, component):
    color = case(namespace)
    assert color[component] > 2 * max(color[:component] + color[component + 1:])


def test_black():
    assert max(case("black")) < 0.2


def test_robots_with_other_names_have_colours_of_their_own():
    assert len({case(f"jetbot_{number:02}") for number in range(1, 31)}) == 30
    assert case("jetbot_01") == case("jetbot_01")


def test_without_a_name_nothing_changes():
    assert paint(URDF, "") == paint(URDF, "/") == URDF
