"""When the robot may move: a truth table with a clock turned by hand."""

import math

import pytest

from jetbot_ros.safety import STOPPED, State

GO = (0.5, 0.1)
NEW = State(timeout=1.0)
DRIVING, HOLDING = (State(timeout).command(*GO, now=0) for timeout in (1.0, 0))
EMERGENCY = DRIVING.emergency_stop(True)
NOT_FINITE = [(DRIVING.command(*command, now=0.1), STOPPED, "stopped: command was not finite", True)
              for bad in (math.nan, math.inf, -math.inf) for command in ((bad, 0.5), (0.5, bad))]


@pytest.mark.parametrize("state, velocity, status, alarm", [
    (NEW.check_timeout(publishers=1, now=100), STOPPED, "stopped: no command yet", False),
    (DRIVING.check_timeout(publishers=1, now=0.99), GO, "driving", False),
    (DRIVING.check_timeout(publishers=1, now=1), STOPPED, "stopped: no command for 1.0 s", True),
    (HOLDING.check_timeout(publishers=1, now=1e9), GO, "driving", False),
    (DRIVING.check_timeout(publishers=0, now=0.05), STOPPED, "stopped: nobody is left to send commands", True),
    (HOLDING.check_timeout(publishers=0, now=0.05), STOPPED, "stopped: nobody is left to send commands", True),
    (DRIVING.command(0, 0, now=0.1).check_timeout(publishers=0, now=9), STOPPED, "stopped: the command is zero", False),
    (EMERGENCY, STOPPED, "stopped: emergency stop", True),
    (EMERGENCY.command(*GO, now=0.1).check_timeout(publishers=1, now=0.2), STOPPED, "stopped: emergency stop", True),
    (EMERGENCY.command(*GO, now=0.1).emergency_stop(False).check_timeout(publishers=1, now=0.2), STOPPED,
     "stopped: no command since the emergency stop was released", True),
    *NOT_FINITE])
def test_what_may_be_driven_and_why(state, velocity, status, alarm):
    assert (state.velocity, state.status, state.alarm) == (velocity, status, alarm)


def test_a_release_without_an_emergency_changes_nothing():
    assert DRIVING.emergency_stop(False) == DRIVING


@pytest.mark.parametrize("stopped", [
    DRIVING.check_timeout(publishers=1, now=5), DRIVING.check_timeout(publishers=0, now=0.1),
    DRIVING.command(math.nan, 0, now=0.1), EMERGENCY.emergency_stop(False)])
def test_whatever_stopped_it_the_next_command_drives_again(stopped):
    assert stopped.velocity == STOPPED
    assert stopped.command(*GO, now=6).velocity == GO


def test_every_command_counts():
    assert EMERGENCY.command(*GO, now=0.5)[5:7] == (0.5, 2)
