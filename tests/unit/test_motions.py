"""How far the motions of the calibration reach, and how gently they start."""

import math

import pytest

from jetbot_tools.motions import STEP, gentle, square, steady


def rolled(motion, min_duty):
    """How far each wheel rolls, in duties times seconds."""
    return tuple(sum(math.copysign(min_duty + (1 - min_duty) * abs(step[wheel]), step[wheel]) * step.seconds
                     for step in motion) for wheel in (0, 1))


@pytest.mark.parametrize("min_duty", [0.0, 0.1])
@pytest.mark.parametrize("seconds", [0.5, 0.7531, 2.0])
def test_a_gentle_motion_reaches_as_far_as_its_speed_does_in_that_time(seconds, min_duty):
    gentle_one, steady_one = gentle(-0.2, 0.2, seconds, min_duty), steady(-0.2, 0.2, seconds)
    assert rolled(gentle_one, min_duty) == pytest.approx(rolled(steady_one, min_duty))
    assert rolled(steady_one, 0.0) == pytest.approx((-0.2 * seconds, 0.2 * seconds))
    assert max(step.seconds for step in gentle_one + steady_one) <= STEP


def test_a_gentle_motion_starts_and_ends_at_an_eighth_of_its_speed():
    speeds = [step.left for step in gentle(0.4, 0.4, 2.0, 0.0)]
    assert (speeds[0], max(speeds), speeds[-1]) == pytest.approx((0.05, 0.4, 0.05))
    assert max(abs(after - before) for before, after in zip(speeds, speeds[1:])) < 0.051


@pytest.mark.parametrize("way", [1, -1])
def test_a_square_has_four_metres_and_one_turn(way):
    motion = square(way, {"max_speed": 0.5, "wheel_separation": 0.12, "min_duty": 0.02})
    left, right = (0.5 * wheel for wheel in rolled(motion, 0.02))
    assert ((left + right) / 2, (right - left) / 0.12) == pytest.approx((4.0, way * math.tau))
