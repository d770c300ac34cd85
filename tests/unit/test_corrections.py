"""What a person sees becomes the parameters of a robot that drives straight, squares included."""

import math

import pytest

from jetbot import InvalidValue
from jetbot.fake.motors import wheel_speeds
from jetbot.kinematics import WHEEL_SEPARATION, Pose
from jetbot_tools.calibration.corrections import (
    base_wiring,
    corrected,
    curvature_of,
    find_errors,
    motor_wiring,
    proportional_alphas,
    trim,
)
from jetbot_tools.calibration.motions import DRIVE_SPEED

PARAMETERS = {"left_motor_alpha": 1.0, "right_motor_alpha": 1.0, "max_speed": 0.6,
              "wheel_separation": 0.1125}


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


def squares(robot, parameters):
    """Where the robot, {"left": m/s, "right": m/s, "separation": m}, ends after each square."""
    left, right = (robot[wheel] * parameters[f"{wheel}_motor_alpha"] / parameters["max_speed"]
                   for wheel in ("left", "right"))
    roll = math.pi / 4 * parameters["wheel_separation"]
    ends = []
    for way in (1, -1):
        pose = Pose()
        for _ in range(4):
            pose = pose.integrate_arc(left, right, robot["separation"])
            pose = pose.integrate_arc(-way * roll * left, way * roll * right, robot["separation"])
        ends.append(complex(pose.x, pose.y))
    return ends


@pytest.mark.parametrize("ratio, separation", [(0.97, 1.08), (1.03, 1.08), (0.97, 0.92), (1.03, 0.92), (0.99, 1.3)])
def test_two_rounds_of_squares_correct_trim_speed_and_separation(ratio, separation):
    robot = {"left": 0.6 / math.sqrt(ratio), "right": 0.6 * math.sqrt(ratio), "separation": 0.1125 * separation}
    parameters, misses = PARAMETERS, []
    for _ in range(3):
        ends = squares(robot, parameters)
        misses.append(max(map(abs, ends)))
        parameters = {**parameters, **corrected(parameters, find_errors(ends))}
    assert misses[0] > 0.5 and misses[1] < 0.12 and misses[2] < 0.02
    assert parameters["wheel_separation"] == pytest.approx(robot["separation"], rel=0.005)
    assert parameters["max_speed"] == pytest.approx(robot["left"] * parameters["left_motor_alpha"], rel=0.005)


def test_ends_that_no_robot_reaches_are_refused():
    with pytest.raises(InvalidValue, match="^No robot ends like that after both squares. Check ahead and behind"):
        find_errors([1 + 1j, 1 + 1j])
