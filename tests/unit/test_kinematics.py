"""The workshop's mixing, and the JetBot's measures wherever a file that cannot import them repeats them."""

import re

import pytest

from conftest import PACKAGES
from jetbot.kinematics import FULL_SPEED, WHEEL_RADIUS, WHEEL_SEPARATION, mix, unmix

MEASURES = {"wheel_separation": WHEEL_SEPARATION, "wheel_diameter": 2 * WHEEL_RADIUS, "max_speed": FULL_SPEED}
REPEATED = [("jetbot_control_node/config/si_units.yaml", 2), ("simulation/config/jetbot.yaml", 3)]


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


@pytest.mark.parametrize("files, count", REPEATED)
def test_files_that_repeat_the_measures_agree(files, count):
    text = "\n".join(file.read_text() for file in PACKAGES.glob(files))
    repeated = re.findall(r"^(?:export )?(?:const )?(\w+)(?:: | = )([\d.]+)", text, re.M)
    found = [MEASURES[name] == float(number) for name, number in repeated if name in MEASURES]
    assert found == [True] * count
