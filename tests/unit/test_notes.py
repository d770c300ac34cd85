"""What the status reports beside "driving"."""

from unittest.mock import Mock

import pytest

from jetbot_control_node.notes import (
    LASTING,
    NOTE_FOR,
    RIVALS_WITHIN,
    TOO_SLOW,
    Commanders,
    Disturbances,
    Lasting,
    TooSlow,
)
from jetbot_control_node.safety import Sender

NONE = {"resets": 0, "overwritten": 0, "faults": 0}


def commanded_by(*names):
    commanders = Commanders()
    for name in names:
        commanders.record(Sender(name), now=0.0)
    return commanders


def test_one_program_is_no_news():
    assert commanded_by("/pupil").note({"/pupil", "/idle"}, now=0.1) is None


def test_two_programs_are_both_named_while_both_send():
    commanders = commanded_by("/teleop", "/circle")
    assert commanders.note({"/teleop", "/circle"}, now=0.1) == "2 programs command it: /circle and /teleop"
    commanders.record(Sender("/circle"), now=1.0)
    assert commanders.note({"/teleop", "/circle"}, now=RIVALS_WITHIN) is None


def test_a_standing_order_counts_until_its_program_ends():
    commanders = commanded_by("/teleop")
    commanders.record(Sender("/order", latched=True), now=0.0)
    commanders.record(Sender("/teleop"), now=60.0)
    assert commanders.note({"/teleop", "/order"}, now=60.1) == "2 programs command it: /order and /teleop"
    assert commanders.note({"/teleop"}, now=60.2) is None


def test_a_program_that_has_ended_is_not_named():
    assert commanded_by("/teleop", "/circle").note({"/circle"}, now=0.1) is None


def test_of_many_programs_two_are_named():
    names = [f"/pupil_{i:03}" for i in range(200)]
    assert commanded_by(*names).note(names, now=0.1) == "200 programs command it: /pupil_000, /pupil_001 and 198 more"


def test_who_is_ignored_while_a_person_drives():
    commanders = commanded_by("/circle")
    commanders.record(Sender("/jetbot_cockpit", manual=True), now=0.0)
    everybody = {"/circle", "/jetbot_cockpit", "/square"}
    assert commanders.ignored(everybody, now=0.1) == "/circle waits for the cockpit"
    commanders.record(Sender("/square"), now=0.1)
    assert commanders.ignored(everybody, now=0.2) == "/circle and /square wait for the cockpit"
    assert commanders.ignored(everybody, now=RIVALS_WITHIN + 0.1) is None


def test_what_costs_motion_is_reported_for_a_while():
    disturbances = Disturbances()
    assert disturbances.notes(NONE, now=0.0) == []
    reset = {**NONE, "resets": 1}
    assert disturbances.notes(reset, now=1.0) == [
        "its board has lost its settings (1 so far): check the battery and the plugs"]
    assert disturbances.notes(reset, now=1.0 + NOTE_FOR) == []


def test_one_fault_has_a_status_of_its_own_but_several_are_counted():
    disturbances = Disturbances()
    assert disturbances.notes({**NONE, "faults": 1}, now=0.0) == []
    assert disturbances.notes({**NONE, "faults": 2}, now=9.0) == [
        "its board keeps failing to answer (2 so far): check the wires"]


@pytest.mark.parametrize("closed_loop, advice", [(False, "raise min_duty"), (True, "command more")])
def test_wheels_that_get_less_than_a_step_of_the_board_are_reported_with_advice(closed_loop, advice):
    robot = Mock(**{"left_motor.value": -0.0001, "driver.closed_loop": closed_loop, "driver.resolution": 0.0002})
    too_slow = TooSlow(robot)
    assert [too_slow((-0.0001, 0.0), now) for now in (0.0, LASTING)] == [None, TOO_SLOW + advice]
    assert too_slow((0.0, -0.0002), now=LASTING) is None


def test_wheels_that_are_commanded_to_stop_are_not_too_slow():
    too_slow = TooSlow(Mock(**{"left_motor.value": 0.0, "right_motor.value": 0.0, "driver.resolution": 0.0002}))
    assert [too_slow((0.0, 0.0), now) for now in (0.0, LASTING)] == [None, None]


def test_a_condition_is_reported_while_it_has_lasted():
    lasting = Lasting()
    assert lasting.note("slow", now=0.0) is None
    assert lasting.note("slow", now=LASTING) == "slow"
    assert lasting.note(None, now=LASTING) is None
    assert lasting.note("slow", now=LASTING + 0.1) is None
