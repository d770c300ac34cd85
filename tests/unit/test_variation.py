"""With a variation, each simulated robot drives a little differently, always the same; without, all as the model."""

import math

import pytest

from simulation import variation
from simulation.diff_drive import STEP, DiffDriveModel
from simulation.variation import Variation, Wheel

CLASS = [f"jetbot_{number:02d}" for number in range(1, 16)]


def drive(traits, speeds, seconds=2.0, **options):
    """Return a robot with these traits, once it has driven."""
    robot = DiffDriveModel(variation=traits, **options)
    for _ in range(round(seconds / STEP)):
        robot.step(speeds)
    return robot


def test_without_a_variation_every_robot_drives_exactly_as_the_model():
    exact = drive(Variation(), (0.5, 0.47))
    assert {drive(variation.draw(name, 0.0), (0.5, 0.47)).pose for name in CLASS} == {exact.pose}


def test_a_robot_drives_as_its_name_says_and_each_name_otherwise():
    assert variation.draw("jetbot_07", 0.5).left.gain == pytest.approx(0.99497, abs=1e-5), "the same on each computer"
    ends = [[drive(variation.draw(name, 0.5), (0.5, 0.5)).pose for name in CLASS] for _ in range(2)]
    assert ends[0] == ends[1] and len(set(ends[0])) == len(CLASS)


def test_a_metre_by_the_clock_ends_some_centimetres_off_and_farther_off_with_more_variation():
    goal = drive(Variation(), (0.5, 0.5), 3.3).pose[:2]
    for name in CLASS:
        errors = [math.dist(drive(variation.draw(name, amount), (0.5, 0.5), 3.3).pose[:2], goal)
                  for amount in (0.1, 0.5, 1.0)]
        assert 0 < errors[0] < errors[1] < errors[2] and 0.02 < errors[2] < 0.6


@pytest.mark.parametrize("traits, speeds, velocity", [
    (Variation(left=Wheel(gain=0.9)), (0.5, 0.5), (0.285, 0.03 / 0.1125)),
    (Variation(right=Wheel(dead_band=2.0)), (0.09, 0.09), (0.027, -0.054 / 0.1125)),
    (Variation(left=Wheel(grip=0.9), right=Wheel(grip=0.9)), (0.5, 0.5), (0.27, 0)),
    (Variation(sag=0.1), (1.0, 1.0), (0.54, 0)), (Variation(sag=0.1), (0.5, -0.5), (0, -0.57 / 0.1125))])
def test_a_weak_motor_one_that_sticks_a_wheel_that_slips_and_a_supply_that_sags(traits, speeds, velocity):
    assert drive(traits, speeds).velocity == pytest.approx(velocity, abs=1e-6)


def test_a_wheel_that_slips_turns_on():
    robot = drive(Variation(Wheel(grip=0.9), Wheel(grip=0.9)), (0.5, 0.5))
    assert robot.pose.x == pytest.approx(0.9 * robot.left.distance)


def test_where_a_board_controls_the_wheels_they_slip_and_nothing_else():
    traits = Variation(Wheel(0.9, 2.0, 0.95), Wheel(1.1, 2.0, 0.95), 0.1)
    assert drive(traits, (0.3, 0.3), closed_loop=True).velocity == pytest.approx((0.95 * 0.3, 0))
