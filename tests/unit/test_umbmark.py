"""The errors found from two squares, against squares that a robot with such errors drives exactly."""

import math

import pytest

from jetbot import InvalidValue
from jetbot_tools.umbmark import Errors, corrected, find_errors
from simulation.diff_drive import Pose

PARAMETERS = {"left_motor_alpha": 1.0, "right_motor_alpha": 1.0, "min_duty": 0.0, "max_speed": 0.6,
              "wheel_separation": 0.1125}


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


def test_a_good_robot_has_no_errors():
    good = {"left": 0.6, "right": 0.6, "separation": 0.1125}
    assert find_errors(squares(good, PARAMETERS)) == pytest.approx((0.0, 0.0), abs=1e-3)


@pytest.mark.parametrize("ratio, separation", [(0.97, 1.08), (1.03, 1.08), (0.97, 0.92), (1.03, 0.92), (0.99, 1.3)])
def test_one_round_corrects_trim_speed_and_separation(ratio, separation):
    robot = {"left": 0.6 / math.sqrt(ratio), "right": 0.6 * math.sqrt(ratio), "separation": 0.1125 * separation}
    before = squares(robot, PARAMETERS)
    parameters = {**PARAMETERS, **corrected(PARAMETERS, find_errors(before))}
    assert max(map(abs, before)) > 0.5
    assert max(map(abs, squares(robot, parameters))) < 0.12
    parameters.update(corrected(parameters, find_errors(squares(robot, parameters))))
    assert max(map(abs, squares(robot, parameters))) < 0.02
    assert parameters["wheel_separation"] == pytest.approx(robot["separation"], rel=0.005)
    assert parameters["max_speed"] == pytest.approx(robot["left"] * parameters["left_motor_alpha"], rel=0.005)


def test_ends_that_no_robot_reaches_are_refused():
    with pytest.raises(InvalidValue, match="^No robot ends like that after both squares. Check ahead and behind"):
        find_errors([1 + 1j, 1 + 1j])


def test_errors_are_to_the_left_and_too_much():
    robot = {"left": 0.59, "right": 0.61, "separation": 0.1}
    curvature, excess = find_errors(squares(robot, PARAMETERS))
    assert Errors(curvature, excess) == pytest.approx((0.02 / 0.6 / 0.1, math.pi / 2 * 0.125), rel=0.02)
