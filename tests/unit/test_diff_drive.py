"""The workshop's mixing; the simulated robot against closed forms: arcs, lag, dead band, and a closed loop."""

import math

import pytest

from jetbot.fake.motors import dead_band_factor
from jetbot.kinematics import Pose, mix, unmix
from simulation.diff_drive import Body, DiffDriveModel, Motor

SEPARATION, MAX_SPEED = 0.1125, 0.6
IDEAL = Body(motor_lag=0.0, dead_band=0.0)


def model(closed_loop=False, **body):
    return DiffDriveModel(IDEAL._replace(**body), closed_loop=closed_loop)


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


@pytest.mark.parametrize("steps", [1, 1000])
@pytest.mark.parametrize("linear, angular", [(0.5, 0.0), (-0.3, 0.0), (0.5, 0.1), (0.2, -1.5), (-0.3, 0.7), (0, 2.0)])
def test_drives_the_arc_of_linear_and_angular_speed(linear, angular, steps):
    robot, turn = model(), angular * SEPARATION / 2
    for _ in range(steps):
        robot.step(((linear - turn) / MAX_SPEED, (linear + turn) / MAX_SPEED), 2.0 / steps)
    yaw = angular * 2.0
    x = linear / angular * math.sin(yaw) if angular else linear * 2.0
    y = linear / angular * (1 - math.cos(yaw)) if angular else 0.0
    assert robot.pose == pytest.approx((x, y, math.remainder(yaw, 2 * math.pi)), abs=1e-9)
    assert robot.velocity == pytest.approx((linear, angular))


@pytest.mark.parametrize("linear, angular", [(0.5, 1.0), (-0.3, -0.7), (0.01, 0.0), (2.0, 0.0)])
def test_closed_loop_drives_the_velocity_of_the_twist_without_a_dead_band(linear, angular):
    robot = model(dead_band=0.1, closed_loop=True)
    robot.step((linear - angular, linear + angular), 1.0)
    assert robot.velocity == pytest.approx((linear, angular))


@pytest.mark.parametrize("steps", [1, 50])
def test_lag(steps):
    motor = Motor(MAX_SPEED, lag=0.2, dead_band=0.0)
    rolled = sum(motor.step(1.0, 0.2 / steps) for _ in range(steps))
    assert motor.speed == pytest.approx(MAX_SPEED * (1 - 1 / math.e))
    assert rolled == pytest.approx(MAX_SPEED * 0.2 / math.e)
    assert motor.distance == pytest.approx(rolled)


@pytest.mark.parametrize("frequency, starts_at", [(1600, 0.28), (25, 0.02)])
def test_below_its_dead_band_a_wheel_stalls_and_the_band_shrinks_with_the_pwm_frequency_as_measured(
        frequency, starts_at):
    dead_band = 0.28 / dead_band_factor(1600)
    motor = Motor(MAX_SPEED, lag=0.0, dead_band=dead_band)
    for duty, stalled in ((0.98 * starts_at, True), (-0.98 * starts_at, True), (1.02 * starts_at, False), (0, False)):
        motor.step(duty, 1.0, frequency)
        assert motor.stalled == stalled
        assert motor.speed == pytest.approx(0 if stalled else duty * MAX_SPEED)


def test_the_wheels_that_get_too_little_to_turn_are_named():
    robot = model(dead_band=0.05)
    for duties, stalled in (((-0.047, 0.047), {"left": -0.047, "right": 0.047}), ((0.0, 0.049), {"right": 0.049}),
                            ((0.0, 0.05), {})):
        robot.step(duties)
        assert robot.stalled == stalled


@pytest.mark.parametrize("closed_loop, speeds", [(False, (0.5, 0.5)), (True, (0.3, 0.3))])
def test_a_smaller_right_wheel_turns_as_fast_and_drives_less_far(closed_loop, speeds):
    robot = model(wheel_ratio=0.97, closed_loop=closed_loop)
    robot.step(speeds, 2.0)
    assert (robot.left.distance, robot.right.distance) == pytest.approx((0.6, 0.97 * 0.6))
    assert robot.pose.yaw == pytest.approx(-0.03 * 0.6 / SEPARATION)
    angles, rates = robot.joints
    assert (angles, rates) == (pytest.approx((20, 20)), pytest.approx((10, 10)))  # of 0.03 m in radius, at 0.3 m/s


def test_a_robot_that_is_placed_while_it_rolls_is_at_rest_there_as_it_was_at_its_start():
    robot, start = DiffDriveModel(), Pose(1.0, 2.0, math.pi / 2)
    robot.step((1.0, 0.5), 1.0)
    assert robot.moving
    robot.place(start)
    assert (robot.velocity, robot.joints, robot.moving) == ((0, 0), ((0, 0), (0, 0)), False)
    robot.step((0.0, 0.0), 1.0)
    assert robot.pose == start
    robot.step((0.5, 0.5), 10.0)
    assert (robot.pose.x, robot.pose.yaw) == pytest.approx((1.0, math.pi / 2))
