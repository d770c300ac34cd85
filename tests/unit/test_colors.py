"""The robots of a class are distinguished by their colours, on white and on black."""

from itertools import combinations

import pytest

from jetbot_ros.colors import color_of, luminance

CLASS = [f"jetbot_{number:02}" for number in range(1, 100)]


@pytest.mark.parametrize("name", [*CLASS, "kit_7", "Ada", ""])
def test_a_colour_is_readable_on_white_and_on_black(name):
    brightness = luminance(color_of(name))
    assert 1.05 / (brightness + 0.05) >= 3
    assert (brightness + 0.05) / 0.05 >= 3


def test_no_two_robots_of_a_class_have_the_same_colour():
    assert len({color_of(name) for name in CLASS}) == len(CLASS)


def test_the_first_robots_differ_most():
    for color, other in combinations(map(color_of, CLASS[:16]), 2):
        assert max(abs(part - another) for part, another in zip(color, other)) > 0.15


def test_a_name_has_always_the_same_colour():
    assert color_of("Ada") == color_of("Ada") != color_of("Bob")


def test_a_robot_without_a_name_is_not_as_red_as_the_cockpits_stop():
    red, green, blue = color_of("")
    assert blue > max(red, green)
