"""How a ramp limits the wheels' acceleration, with times handed in."""

import math
import random
from types import SimpleNamespace

import pytest

from jetbot.kinematics import mix
from jetbot_control_node.control.ramp import MAX_STEP, Ramp, make_ramp
from jetbot_control_node.control.state_machine import STOPPED
from jetbot_control_node.parameters import checked

SEPARATION = 0.1125  # m
STEP = 0.01          # s
OPEN_LOOP = SimpleNamespace(closed_loop=False, limit=1.0)
CLOSED_LOOP = SimpleNamespace(closed_loop=True, limit=32.767)


@pytest.fixture
def ramp():
    """1 m/s^2, stopped until the time 0."""
    ramp = Ramp(1.0, SEPARATION, full_speed=0.6)
    ramp.limit(STOPPED, 0.0)
    return ramp


def drive(ramp, velocity, start, seconds):
    """Return the wheel speeds (left, right) in m/s of each step from ``start`` on."""
    moments = [start + STEP * (i + 1) for i in range(round(seconds / STEP))]
    return [mix(*ramp.limit(velocity, now), SEPARATION) for now in moments]


def test_without_a_limit_every_velocity_is_driven_at_once():
    ramp = Ramp()
    assert ramp.limit((0.5, 0.1), 0.0) == (0.5, 0.1)
    assert not ramp.active


def test_a_start_takes_as_long_as_the_limit_says_and_ends_at_exactly_the_command(ramp):
    speeds = [left for left, _ in drive(ramp, (0.5, 0.0), 0.0, 0.5)]
    assert speeds[:-1] == pytest.approx([STEP * (i + 1) for i in range(49)])
    assert speeds[-1] == 0.5
    assert not ramp.active


@pytest.mark.parametrize("velocity", [(0.3, 1.0), (0.3, -4.0), (0.0, 2.0), (-0.2, 0.5), (9.0, 1.0)])
def test_the_arc_is_kept_while_the_robot_speeds_up(ramp, velocity):
    *ramping, last = drive(ramp, velocity, 0.0, 0.05)
    assert last == pytest.approx([5 * speed for speed in ramping[0]])


@pytest.mark.parametrize("before, after", [
    ((0.5, 0.0), (0.2, 0.0)), ((0.5, 0.0), STOPPED), ((-0.5, 2.0), (-0.2, 0.8))])
def test_slowing_down_and_stopping_take_no_time(ramp, before, after):
    drive(ramp, before, 0.0, 1.0)
    assert ramp.limit(after, 1.001) == after
    assert not ramp.active


def test_a_reversal_passes_through_zero_at_once_and_then_ramps(ramp):
    drive(ramp, (0.5, 0.0), 0.0, 1.0)
    assert drive(ramp, (-0.5, 0.0), 1.0, 0.02) == [pytest.approx((-0.01, -0.01)), pytest.approx((-0.02, -0.02))]


def test_whatever_is_commanded_and_when_no_wheel_gets_faster_than_the_limit_allows(ramp):
    numbers = random.Random(1)
    before, now = (0.0, 0.0), 0.0
    for _ in range(20000):
        elapsed = numbers.choice([0.0, 1e-6, 0.001, 0.01, 0.05, 0.4, 3.0])
        now += elapsed
        velocity = numbers.choice([STOPPED, (numbers.uniform(-1, 1), numbers.uniform(-9, 9)), (1e300, -1e300)])
        speeds = [max(-0.6, min(0.6, speed)) for speed in mix(*ramp.limit(velocity, now), SEPARATION)]
        for speed, was in zip(speeds, before):
            grown = abs(speed) - (abs(was) if speed * was > 0 else 0)
            assert grown <= min(elapsed, MAX_STEP) + 1e-9
        before = speeds


@pytest.mark.parametrize("stop", [Ramp.reset, lambda ramp: ramp.limit((0.5, 0.0), 1.6)], ids=["reset", "a freeze"])
def test_after_a_stop_without_a_command_it_starts_again_at_zero(ramp, stop):
    drive(ramp, (0.5, 0.0), 0.0, 1.0)
    stop(ramp)
    assert ramp.active
    assert ramp.limit((0.5, 0.0), 1.61)[0] <= 0.04


def test_a_command_beyond_full_speed_takes_no_longer_than_full_speed(ramp):
    drive(ramp, (1e300, 1e300), 0.0, 0.65)
    assert not ramp.active


def test_the_limit_is_in_the_units_of_the_commands():
    ramp = make_ramp(checked({"acceleration_limit": 0.5, "wheel_separation": 0.2, "max_speed": 2.0}), OPEN_LOOP)
    ramp.limit(STOPPED, 0.0)
    assert ramp.limit((0.0, 1.0), 0.01) == pytest.approx((0.0, 0.05))


def test_a_trimmed_wheel_reaches_full_power_within_the_limit():
    ramp = make_ramp(checked({"acceleration_limit": 1.0, "left_motor_alpha": 0.5, "right_motor_alpha": 0}), OPEN_LOOP)
    ramp.limit(STOPPED, 0.0)
    linear = [ramp.limit((9.0, 0.0), STEP * i)[0] for i in range(1, 202)]
    assert (linear[198], linear[-1]) == (pytest.approx(1.99), 9.0)


def test_a_board_that_takes_a_twist_as_it_is_has_real_wheels():
    ramp = make_ramp(checked({"acceleration_limit": 1.0, "max_speed": 0.1}), CLOSED_LOOP)
    ramp.limit(STOPPED, 0.0)
    assert ramp.limit((0.0, 2.0), 0.01)[1] == pytest.approx(0.02 / SEPARATION)
    assert math.isclose(ramp.limit((2.0, 0.0), 0.02)[0], 0.01)
