"""How far the motions of the calibration reach, and how gently they start."""

import math

import pytest

from jetbot_tools.motions import STEP, gentle, square, steady


def rolled(motion):
    """How far each wheel rolls, in fractions of full power times seconds."""
    return tuple(sum(step[wheel] * step.seconds for step in motion) for wheel in (0, 1))


@pytest.mark.parametrize("make", [gentle, steady])
@pytest.mark.parametrize("seconds", [0.4, 0.7531, 2.0])
def test_reaches_as_far_as_the_speeds_do_in_that_time(make, seconds):
    motion = make(-0.2, 0.4, seconds)
    assert rolled(motion) == pytest.approx((-0.2 * seconds, 0.4 * seconds))
    assert max(step.seconds for step in motion) <= STEP


def test_a_gentle_motion_starts_and_ends_at_an_eighth_of_its_speed():
    motion = gentle(0.4, 0.4, 2.0)
    speeds = [step.left for step in motion]
    assert (speeds[0], max(speeds), speeds[-1]) == pytest.approx((0.05, 0.4, 0.05))
    assert max(abs(after - before) for before, after in zip(speeds, speeds[1:])) < 0.051


@pytest.mark.parametrize("way", [1, -1])
def test_a_square_has_four_metres_and_one_turn(way):
    left, right = (0.5 * wheel for wheel in rolled(square(way, {"max_speed": 0.5, "wheel_separation": 0.12})))
    assert ((left + right) / 2, (right - left) / 0.12) == pytest.approx((4.0, way * math.tau))
