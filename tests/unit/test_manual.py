"""A person at the cockpit has priority over programs: what test_state.py meets too rarely to show."""

import math

import pytest

from jetbot_control_node.control.state_machine import MANUAL_PRIORITY, STOPPED, Sender, State
from jetbot_ros.state import EMERGENCY_STOP, OWN_EMERGENCY_STOP

COCKPIT, SCENARIO = Sender("/jetbot_cockpit", manual=True, number=1), Sender("/jetbot_motion_control", number=2)
BY_HAND, MOTION = (0.2, -0.3), (0.5, 0.1)
SOON = MANUAL_PRIORITY - 0.01
DRIVING = State(timeout=1.0).command(*MOTION, SCENARIO, now=-1).command(*BY_HAND, COCKPIT, now=0)
HOLDING = State(timeout=0.0).command(*BY_HAND, COCKPIT, now=0)
EMERGENCY = DRIVING.hold(EMERGENCY_STOP, True)


@pytest.mark.parametrize("stopped", [
    DRIVING.command(0, 0, COCKPIT, now=0),                      # released
    DRIVING.command(math.nan, 0, COCKPIT, now=0),
    DRIVING.disconnect(COCKPIT, others=True),            # killed
    HOLDING.disconnect(COCKPIT, others=True),
    HOLDING.check_timeout(now=1.0),                       # frozen
    DRIVING.check_timeout(now=1.0),
    EMERGENCY.hold(EMERGENCY_STOP, False),
    DRIVING.hold(OWN_EMERGENCY_STOP, True).hold(OWN_EMERGENCY_STOP, False)])
def test_whatever_ended_it_the_scenario_drives_5_s_after_the_last_manual_command_only(stopped):
    assert stopped.speeds == stopped.command(*MOTION, SCENARIO, now=SOON).speeds == STOPPED
    assert stopped.command(*MOTION, SCENARIO, now=MANUAL_PRIORITY).speeds == MOTION


def test_a_person_who_drives_on_during_an_emergency_stop_keeps_the_priority():
    state = EMERGENCY.command(*BY_HAND, COCKPIT, now=2.0).hold(EMERGENCY_STOP, False)
    assert state.command(*MOTION, SCENARIO, now=2.0 + SOON).speeds == STOPPED
    assert state.command(*BY_HAND, COCKPIT, now=2.1).speeds == BY_HAND


def test_the_two_emergency_stops_hold_the_robot_each():
    both = EMERGENCY.hold(OWN_EMERGENCY_STOP, True)
    assert both.cause.code == EMERGENCY_STOP
    own = both.hold(EMERGENCY_STOP, False)
    assert own.cause.code == OWN_EMERGENCY_STOP
    assert own.command(*BY_HAND, COCKPIT, now=1).speeds == STOPPED
    assert own.hold(OWN_EMERGENCY_STOP, False).command(*BY_HAND, COCKPIT, now=1).speeds == BY_HAND
