"""What a person sees becomes the parameters of a robot that drives straight."""

import math

import pytest

from jetbot import InvalidValue
from jetbot.fake.motors import wheel_speeds
from jetbot.kinematics import WHEEL_SEPARATION
from jetbot_tools.calibration.corrections import (
    base_wiring,
    curvature_of,
    motor_wiring,
    proportional_alphas,
    trim,
)
from jetbot_tools.calibration.motions import DRIVE_SPEED


@pytest.mark.parametrize("left_output, right_output, swap, left, right", [
    (("left", 1), ("right", 1), False, False, False),
    (("left", -1), ("right", 1), False, True, False),
    (("right", 1), ("left", 1), True, False, False),
    (("right", -1), ("left", -1), True, True, True),
])
def test_motor_wiring(left_output, right_output, swap, left, right):
    assert motor_wiring(left_output, right_output) == {"swap_motors": swap, "invert_left": left, "invert_right": right}


@pytest.mark.parametrize("ahead, turn", [(1, 1), (1, -1), (-1, 1), (-1, -1)])
def test_base_wiring(ahead, turn, make_robot, folder):
    make_robot(**base_wiring(ahead, turn)).set_motors(0.2, 0.6)
    left, right = wheel_speeds(folder)
    assert (ahead * (left + right) / 2, turn * (right - left) / 2) == pytest.approx((0.4, 0.2), abs=0.0003)


def test_one_wheel_cannot_turn_at_both_outputs():
    with pytest.raises(InvalidValue, match="^The left wheel cannot have turned both times. Repeat both motions.$"):
        motor_wiring(("left", 1), ("left", -1))


@pytest.mark.parametrize("left, right", [(1.0, 0.95), (0.9, 1.0), (1.0, 1.0)])
def test_trim_makes_the_wheels_equal(left, right):
    curvature = (right - left) / (WHEEL_SEPARATION * (right + left) / 2)
    drift = math.copysign((1 - math.sqrt(1 - curvature ** 2)) / curvature, curvature) if curvature else 0
    left_alpha, right_alpha = trim(1.0, 1.0, curvature_of(drift))
    assert left * left_alpha == pytest.approx(right * right_alpha, rel=1e-3)
    assert max(left_alpha, right_alpha) == 1


def test_trim_knows_that_an_alpha_leaves_the_min_duty_as_it_is():
    left, right = (0.1 + 0.9 * alpha * DRIVE_SPEED for alpha in trim(1.0, 1.0, 0.4, min_duty=0.1))
    assert left * (1 - 0.2 * WHEEL_SEPARATION) == pytest.approx(right * (1 + 0.2 * WHEEL_SEPARATION), rel=1e-3)


def test_a_robot_stays_straight_without_its_min_duty():
    left, right = (0.1 + 0.9 * alpha * DRIVE_SPEED for alpha in (0.9, 1.0))
    assert proportional_alphas(0.9, 1.0, min_duty=0.1) == pytest.approx((left / right, 1.0), rel=1e-3)
