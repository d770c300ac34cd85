import sys

import pytest

from jetbot.kinematics import mix


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


def test_huge_commands_stay_finite():
    largest = sys.float_info.max
    assert mix(-1e308, 1e308) == (-largest, 0.0)
    assert mix(1e308, -1e308, wheel_separation=1e308, max_speed=1e-300) == (largest, -largest)
