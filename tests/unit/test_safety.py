"""When the robot may move: a truth table with a clock turned by hand."""

import math

import pytest

from jetbot_ros.safety import STILL, Safety

GO = (0.5, 0.1)


@pytest.fixture
def safety():
    return Safety(timeout=1.0)


def test_nothing_moves_before_the_first_command(safety):
    safety.watch(publishers=1, now=100)
    assert (safety.velocity, safety.reason, safety.alarm) == (STILL, "stopped: no command yet", False)


def test_a_command_moves(safety):
    safety.command(*GO, now=0)
    safety.watch(publishers=1, now=0.99)
    assert (safety.velocity, safety.reason, safety.alarm) == (GO, "driving", False)


def test_a_zero_command_stops_without_alarm(safety):
    safety.command(*GO, now=0)
    safety.command(0, 0, now=0.1)
    safety.watch(publishers=0, now=99)
    assert (safety.velocity, safety.reason, safety.alarm) == (STILL, "stopped: the command is zero", False)


def test_silence_stops(safety):
    safety.command(*GO, now=0)
    safety.watch(publishers=1, now=1)
    assert (safety.velocity, safety.reason, safety.alarm) == (STILL, "stopped: no command for 1.0 s", True)


def test_timeout_0_holds_the_last_command():
    safety = Safety(timeout=0)
    safety.command(*GO, now=0)
    safety.watch(publishers=1, now=1e9)
    assert safety.velocity == GO


@pytest.mark.parametrize("timeout", [0, 1.0])
def test_the_last_publishers_end_stops(timeout):
    safety = Safety(timeout)
    safety.command(*GO, now=0)
    safety.watch(publishers=0, now=0.05)
    assert (safety.velocity, safety.reason) == (STILL, "stopped: nobody is left to send commands")


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("place", [0, 1])
def test_a_command_that_is_not_finite_stops(safety, bad, place):
    command = [0.5, 0.5]
    command[place] = bad
    safety.command(*GO, now=0)
    safety.command(*command, now=0.1)
    assert (safety.velocity, safety.reason, safety.alarm) == (STILL, "stopped: command was not finite", True)


def test_an_emergency_stop_latches(safety):
    safety.command(*GO, now=0)
    safety.emergency_stop(True)
    assert (safety.velocity, safety.reason, safety.alarm) == (STILL, "stopped: emergency stop", True)
    safety.command(*GO, now=0.1)
    safety.watch(publishers=1, now=0.2)
    assert (safety.velocity, safety.reason) == (STILL, "stopped: emergency stop")


def test_after_the_release_only_a_new_command_moves(safety):
    safety.command(*GO, now=0)
    safety.emergency_stop(True)
    safety.command(*GO, now=0.1)
    safety.emergency_stop(False)
    safety.watch(publishers=1, now=0.2)
    assert (safety.velocity, safety.reason) == (STILL, "stopped: no command since the emergency stop was released")
    safety.command(*GO, now=0.3)
    assert safety.velocity == GO


def test_a_release_without_an_emergency_changes_nothing(safety):
    safety.command(*GO, now=0)
    safety.emergency_stop(False)
    assert safety.velocity == GO


@pytest.mark.parametrize("stop", [
    lambda safety: safety.watch(publishers=1, now=5),
    lambda safety: safety.watch(publishers=0, now=0.1),
    lambda safety: safety.command(math.nan, 0, now=0.1),
])
def test_whatever_stopped_it_the_next_command_drives_again(safety, stop):
    safety.command(*GO, now=0)
    stop(safety)
    assert safety.velocity == STILL
    safety.command(*GO, now=6)
    assert safety.velocity == GO
