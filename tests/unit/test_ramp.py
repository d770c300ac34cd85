"""How a ramp limits the wheels' acceleration, with times handed in."""

import math
import random
from types import SimpleNamespace

import pytest

from jetbot.kinematics import WHEEL_SEPARATION, mix
from jetbot_control_node.control.ramp import MAX_STEP, Ramp, make_ramp
from jetbot_control_node.control.state_machine import STOPPED
from jetbot_control_node.parameters import checked

STEP = 0.01  # s


@pytest.fixture
def ramp():
    """Up to full power in a second, stopped until the time 0."""
    ramp = Ramp(1.0)
    ramp.limit(STOPPED, 0.0)
    return ramp


def drive(ramp, speeds, start, seconds):
    """Return the speeds of each step from ``start`` on."""
    return [ramp.limit(speeds, start + STEP * (i + 1)) for i in range(round(seconds / STEP))]


def made(closed_loop=False, **parameters):
    """Return the ramp that the parameters describe, stopped until the time 0."""
    ramp = make_ramp(checked(parameters), SimpleNamespace(closed_loop=closed_loop))
    ramp.limit(STOPPED, 0.0)
    return ramp


def test_a_start_takes_as_long_as_the_limit_says_and_ends_at_exactly_the_command(ramp):
    speeds = [left for left, _ in drive(ramp, (0.5, 0.5), 0.0, 0.5)]
    assert speeds[:-1] == pytest.approx([STEP * (i + 1) for i in range(49)])
    assert speeds[-1] == 0.5
    assert not ramp.active


def test_whatever_is_commanded_and_when_no_wheel_gets_faster_than_the_limit_allows_and_the_arc_is_kept(ramp):
    numbers = random.Random(1)
    before, now = STOPPED, 0.0
    for _ in range(20000):
        elapsed = numbers.choice([0.0, 1e-6, 0.001, 0.01, 0.05, 0.4, 3.0])
        now += elapsed
        slowed = tuple(speed * numbers.random() for speed in before)
        speeds = numbers.choice([STOPPED, slowed, (numbers.uniform(-2, 2), numbers.uniform(-2, 2)), (1e300, -1e300)])
        slower = all(abs(speed) <= abs(was) and speed * was >= 0 for speed, was in zip(speeds, before))
        given = ramp.limit(speeds, now)
        assert given == speeds or not slower or elapsed > 0.5, "slowing down and stopping take no time"
        assert ramp.active == (given != speeds)
        assert math.isclose(given[0] * speeds[1], given[1] * speeds[0], abs_tol=1e-12), "the arc is kept"
        driven = [max(-1.0, min(1.0, speed)) for speed in given]
        for speed, was in zip(driven, before):
            grown = abs(speed) - (abs(was) if speed * was > 0 else 0)
            assert grown <= min(elapsed, MAX_STEP) + 1e-9
        before = driven


@pytest.mark.parametrize("stop", [Ramp.reset, lambda ramp: ramp.limit((0.5, 0.5), 1.6)], ids=["reset", "a freeze"])
def test_after_a_stop_without_a_command_it_starts_again_at_zero(ramp, stop):
    drive(ramp, (0.5, 0.5), 0.0, 1.0)
    stop(ramp)
    assert ramp.active
    assert ramp.limit((0.5, 0.5), 1.61)[0] <= 0.04


def test_a_command_beyond_full_power_reaches_it_as_soon_as_full_power_does(ramp):
    assert min(drive(ramp, (1e300, 1e300), 0.0, 1.0)[-1]) >= 0.999


def test_the_limit_is_in_the_units_of_the_commands():
    ramp = made(acceleration_limit=0.5, wheel_separation=0.2, max_speed=2.0)
    assert ramp.limit(mix(0.0, 1.0, 0.2, 2.0), 0.01) == pytest.approx(mix(0.0, 0.05, 0.2, 2.0))


def test_a_board_that_takes_a_twist_as_it_is_has_real_wheels():
    ramp = made(closed_loop=True, acceleration_limit=1.0, max_speed=0.1)
    assert ramp.limit(mix(0.0, 2.0), 0.01) == pytest.approx(mix(0.0, 0.02 / WHEEL_SEPARATION))
    assert math.isclose(ramp.limit(mix(2.0, 0.0), 0.02)[0], 0.01)


def test_without_a_limit_there_is_no_ramp():
    assert make_ramp(checked({}), SimpleNamespace(closed_loop=False)) is None
