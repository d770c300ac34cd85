"""The simulated body against closed forms: straight, arc and spin; the motor's lag and dead band."""

import math

import pytest

from simulation import ORIGIN, Body, Motor, Pose

SEPARATION, DIAMETER, MAX_SPEED = 0.1125, 0.06, 0.6


def body(lag=0.0, dead_band=0.0, pose=ORIGIN):
    return Body(Motor(MAX_SPEED, lag, dead_band), Motor(MAX_SPEED, lag, dead_band), SEPARATION, DIAMETER, pose)


def duties(linear, angular):
    turn = angular * SEPARATION / 2
    return (linear - turn) / MAX_SPEED, (linear + turn) / MAX_SPEED


@pytest.mark.parametrize("steps", [1, 7, 1000])
@pytest.mark.parametrize("linear, angular", [(0.5, 0.0), (-0.3, 0.0), (0.5, 0.1), (0.2, -1.5), (-0.3, 0.7)])
def test_drives_the_arc_of_linear_and_angular_speed(linear, angular, steps):
    robot = body()
    for _ in range(steps):
        robot.move(duties(linear, angular), 2.0 / steps)
    yaw = angular * 2.0
    x = linear / angular * math.sin(yaw) if angular else linear * 2.0
    y = linear / angular * (1 - math.cos(yaw)) if angular else 0.0
    wrapped = math.remainder(yaw, 2 * math.pi)
    assert robot.pose == pytest.approx((x, y, wrapped), abs=1e-9)
    assert robot.velocity == pytest.approx((linear, angular))


def test_spins_on_the_spot_and_counts_its_heading_around():
    robot = body()
    robot.move(duties(0.0, 4.0), 1.0)
    assert robot.pose == pytest.approx((0, 0, 4.0 - 2 * math.pi))


def test_starts_from_its_pose():
    robot = body(pose=Pose(1.0, 2.0, math.pi / 2))
    robot.move((1.0, 1.0), 1.0)
    assert robot.pose == pytest.approx((1.0, 2.0 + MAX_SPEED, math.pi / 2))


def test_wheels_turn_without_slipping():
    robot = body()
    robot.move((0.5, -1.0), 2.0)
    assert robot.wheel_angles == pytest.approx((2 * 0.3 / 0.03, -2 * 0.6 / 0.03))
    assert robot.wheel_rates == pytest.approx((0.3 / 0.03, -0.6 / 0.03))


@pytest.mark.parametrize("steps", [1, 50])
def test_lag(steps):
    motor = Motor(MAX_SPEED, lag=0.2, dead_band=0.0)
    rolled = sum(motor.turn(1.0, 0.2 / steps) for _ in range(steps))
    assert motor.speed == pytest.approx(MAX_SPEED * (1 - 1 / math.e))
    assert rolled == pytest.approx(MAX_SPEED * 0.2 / math.e)
    assert motor.distance == pytest.approx(rolled)
    motor.turn(0.0, 2.0)
    assert motor.speed == pytest.approx(0, abs=1e-4)


@pytest.mark.parametrize("duty, speed", [
    (0.1, 0.06), (-0.1, -0.06), (0.0999, 0.0), (-0.0999, 0.0), (0.0, 0.0), (1.0, 0.6)])
def test_dead_band(duty, speed):
    motor = Motor(MAX_SPEED, lag=0.0, dead_band=0.1)
    motor.turn(duty, 1.0)
    assert motor.speed == pytest.approx(speed)
