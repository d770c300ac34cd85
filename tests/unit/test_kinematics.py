"""The workshop's mixing, and that of real units."""


import pytest

from jetbot.kinematics import mix, unmix


@pytest.mark.parametrize("x, z, left, right", [
    (0.0, 0.0, 0.0, 0.0),
    (0.5, 0.1, 0.4, 0.6),
    (-0.5, 0.1, -0.6, -0.4),
    (0.0, -1.0, 1.0, -1.0),
    (2.0, 0.5, 1.5, 2.5),
])
def test_defaults_are_the_workshops_mixing(x, z, left, right):
    assert mix(x, z) == pytest.approx((left, right))


def test_real_units():
    assert mix(0.3, 2.0, wheel_separation=0.1, max_speed=0.5) == pytest.approx((0.4, 0.8))


@pytest.mark.parametrize("geometry", [(), (0.1125, 0.6)])
def test_the_motion_of_two_wheels_is_the_one_that_they_were_given(geometry):
    assert unmix(*mix(0.3, -2.0, *geometry), *geometry) == pytest.approx((0.3, -2.0))
