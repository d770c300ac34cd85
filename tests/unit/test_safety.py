"""When the robot may move: a truth table with a clock turned by hand."""

import math

import pytest

from jetbot_ros.safety import STOPPED, State

GO = (0.5, 0.1)
NEW = State(timeout=1.0)
DRIVING = NEW.command(*GO, now=0)


def decision(state):
    return state.velocity, state.status, state.alarm


def test_nothing_moves_before_the_first_command():
    assert decision(NEW.check_timeout(publishers=1, now=100)) == (STOPPED, "stopped: no command yet", False)


def test_a_command_moves():
    assert decision(DRIVING.check_timeout(publishers=1, now=0.99)) == (GO, "driving", False)


def test_a_zero_command_stops_without_alarm():
    stopped = DRIVING.command(0, 0, now=0.1).check_timeout(publishers=0, now=99)
    assert decision(stopped) == (STOPPED, "stopped: the command is zero", False)


def test_a_timeout_stops():
    assert decision(DRIVING.check_timeout(publishers=1, now=1)) == (STOPPED, "stopped: no command for 1.0 s", True)


def test_timeout_0_holds_the_last_command():
    assert State(timeout=0).command(*GO, now=0).check_timeout(publishers=1, now=1e9).velocity == GO


@pytest.mark.parametrize("timeout", [0, 1.0])
def test_the_last_publishers_end_stops(timeout):
    stopped = State(timeout).command(*GO, now=0).check_timeout(publishers=0, now=0.05)
    assert decision(stopped) == (STOPPED, "stopped: nobody is left to send commands", True)


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("place", [0, 1])
def test_a_command_that_is_not_finite_stops(bad, place):
    command = [0.5, 0.5]
    command[place] = bad
    assert decision(DRIVING.command(*command, now=0.1)) == (STOPPED, "stopped: command was not finite", True)


def test_an_emergency_stop_latches():
    stopped = DRIVING.emergency_stop(True)
    assert decision(stopped) == (STOPPED, "stopped: emergency stop", True)
    assert decision(stopped.command(*GO, now=0.1).check_timeout(publishers=1, now=0.2)) == decision(stopped)


def test_after_the_release_only_a_new_command_moves():
    released = DRIVING.emergency_stop(True).command(*GO, now=0.1).emergency_stop(False)
    released = released.check_timeout(publishers=1, now=0.2)
    assert decision(released) == (STOPPED, "stopped: no command since the emergency stop was released", True)
    assert released.command(*GO, now=0.3).velocity == GO


def test_a_release_without_an_emergency_changes_nothing():
    assert DRIVING.emergency_stop(False) == DRIVING


@pytest.mark.parametrize("stopped", [
    DRIVING.check_timeout(publishers=1, now=5), DRIVING.check_timeout(publishers=0, now=0.1),
    DRIVING.command(math.nan, 0, now=0.1)])
def test_whatever_stopped_it_the_next_command_drives_again(stopped):
    assert stopped.velocity == STOPPED
    assert stopped.command(*GO, now=6).velocity == GO


def test_every_command_counts():
    assert DRIVING.emergency_stop(True).command(*GO, now=0.5)[5:7] == (0.5, 2)
