"""A person at the cockpit has priority over programs: a clock turned by hand."""

import math

import pytest

from jetbot_control_node.control.state import MANUAL_PRIORITY, STOPPED, Sender, State
from jetbot_ros.holds import EMERGENCY_STOP, OWN_EMERGENCY_STOP

COCKPIT, SCENARIO = Sender("/jetbot_cockpit", manual=True, number=1), Sender("/jetbot_motion_control", number=2)
BY_HAND, MOTION = (0.2, -0.3), (0.5, 0.1)
SOON = MANUAL_PRIORITY - 0.01
DRIVING = State(timeout=1.0).command(*MOTION, SCENARIO, now=-1).command(*BY_HAND, COCKPIT, now=0)
HOLDING = State(timeout=0.0).command(*BY_HAND, COCKPIT, now=0)
EMERGENCY = DRIVING.hold(EMERGENCY_STOP, True)


def test_the_scenario_does_not_interrupt_a_person():
    assert DRIVING.command(*MOTION, SCENARIO, now=0.1).velocity == BY_HAND
    assert DRIVING.command(0, 0, SCENARIO, now=0.1).velocity == BY_HAND
    assert DRIVING.command(math.nan, 0, SCENARIO, now=0.1).velocity == BY_HAND


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
    assert stopped.velocity == stopped.command(*MOTION, SCENARIO, now=SOON).velocity == STOPPED
    assert stopped.command(*MOTION, SCENARIO, now=MANUAL_PRIORITY).velocity == MOTION


def test_ignored_commands_keep_no_robot_driving():
    state = DRIVING.command(*MOTION, SCENARIO, now=0.9)
    assert state.check_timeout(now=1.0).velocity == STOPPED


def test_a_standing_order_from_before_is_over():
    order = SCENARIO._replace(latched=True)
    state = State(timeout=1.0).command(*MOTION, order, now=-1).command(*BY_HAND, COCKPIT, now=0)
    assert state.held_for is None
    assert state.confirm(order.name, 0.9).check_timeout(now=1.0).velocity == STOPPED


def test_a_zero_has_priority_as_well():
    state = State(timeout=1.0).command(*MOTION, SCENARIO, now=-1).command(0, 0, COCKPIT, now=0)
    assert state.command(*MOTION, SCENARIO, now=SOON).velocity == STOPPED


def test_a_person_who_drives_on_during_an_emergency_stop_keeps_the_priority():
    state = EMERGENCY.command(*BY_HAND, COCKPIT, now=2.0).hold(EMERGENCY_STOP, False)
    assert state.command(*MOTION, SCENARIO, now=2.0 + SOON).velocity == STOPPED
    assert state.command(*BY_HAND, COCKPIT, now=2.1).velocity == BY_HAND


def test_the_two_emergency_stops_hold_the_robot_each():
    both = EMERGENCY.hold(OWN_EMERGENCY_STOP, True)
    assert both.reason == "stopped: emergency stop"
    own = both.hold(EMERGENCY_STOP, False)
    assert own.reason == "stopped: its own emergency stop"
    assert own.command(*BY_HAND, COCKPIT, now=1).velocity == STOPPED
    assert own.hold(OWN_EMERGENCY_STOP, False).command(*BY_HAND, COCKPIT, now=1).velocity == BY_HAND
