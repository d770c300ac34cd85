"""The robots of a class are distinguished by their colours."""

from itertools import combinations

from jetbot_ros.colors import color_of

CLASS = [f"jetbot_{number:02}" for number in range(1, 100)]


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
