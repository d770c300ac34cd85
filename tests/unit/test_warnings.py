"""What the status reports beside "driving"."""

from unittest.mock import Mock

import pytest

from jetbot_control_node.control.state_machine import RECENT, CommandLog, Sender, State
from jetbot_control_node.control.supervisor import Step
from jetbot_control_node.status.notes import (
    LOOK_INTERVAL,
    NOTE_FOR,
    Disturbances,
    Status,
    StatusWatch,
    rivals_note,
    too_slow_note,
    waiting_programs,
    waiting_remark,
)
from jetbot_control_node.status.remarks import remark
from jetbot_ros.state import EMERGENCY_STOP, because, sentence

NONE = {"resets": 0, "overwritten": 0, "faults": 0}
COCKPIT = Sender("/jetbot_cockpit", manual=True)


@pytest.fixture
def supervisor():
    return Mock(commands=CommandLog(), state=State(1.0))


def command(supervisor, *names, now=0.0):
    for name in names:
        supervisor.commands.record(Sender(name), now)


def test_programs_are_named_while_both_send_and_a_standing_order_until_its_program_ends(supervisor):
    command(supervisor, "/teleop", "/circle")
    assert str(rivals_note(supervisor, now=0.1)) == "2 programs command it: /circle and /teleop"
    command(supervisor, "/circle", now=1.0)
    assert rivals_note(supervisor, now=RECENT) is None
    supervisor.commands.record(Sender("/order", latched=True), now=0.0)
    assert str(rivals_note(supervisor, now=2.4)) == "2 programs command it: /circle and /order"
    supervisor.commands.forget("/order")
    assert rivals_note(supervisor, now=2.4) is None
    command(supervisor, *(f"/pupil_{i:03}" for i in range(200)), now=9.0)
    assert str(rivals_note(supervisor, now=9.1)) == "200 programs command it: /pupil_000, /pupil_001 and 198 more"


@pytest.mark.parametrize("names, text", [
    (["/a"], "/a waits for the cockpit"), (["/a", "/b"], "/a and /b wait for the cockpit"),
    (["/a", "/b", "/c"], "/a, /b and /c wait for the cockpit"),
    (["/a", "/b", "/c", "/d"], "/a, /b and 2 more wait for the cockpit")])
def test_a_remark_lists_the_first_few_of_many_programs(names, text):
    assert str(waiting_remark(names)) == text


def test_who_waits_while_a_person_drives(supervisor):
    command(supervisor, "/circle")
    assert waiting_programs(supervisor, now=0.0) == []
    supervisor.commands.record(COCKPIT, now=0.0)
    supervisor.state = supervisor.state.command(0.0, 0.0, COCKPIT, now=0.0)
    assert str(waiting_remark(waiting_programs(supervisor, now=0.1))) == "/circle waits for the cockpit"
    assert rivals_note(supervisor, now=0.1) is None
    command(supervisor, "/square", now=0.1)
    assert str(waiting_remark(waiting_programs(supervisor, now=0.2))) == "/circle and /square wait for the cockpit"
    assert waiting_programs(supervisor, now=RECENT + 0.1) == []


@pytest.mark.parametrize("counts, note", [
    ({"resets": 1}, "its board has lost its settings (1 so far): check the battery and the plugs"),
    ({"overwritten": 3}, "another program writes to its board (3 so far)"),
    ({"faults": 2}, "its board keeps failing to answer (2 so far): check the wires")])
def test_what_costs_motion_is_reported_for_a_while(counts, note):
    disturbances = Disturbances()
    assert disturbances.notes({**NONE, "faults": 1}, now=0.0) == []  # one fault has a status of its own
    assert list(map(str, disturbances.notes({**NONE, **counts}, now=9.0))) == [note]
    assert disturbances.notes({**NONE, **counts}, now=9.0 + NOTE_FOR) == []


@pytest.mark.parametrize("commanded, duties, closed_loop, advice", [
    (-0.0001, (-0.0001, 0.0), False, "raise min_duty"), (-0.0001, (-0.0001, 0.0), True, "command more"),
    (-0.0001, (0.0, -0.0002), False, None), (0.0, (0.0, 0.0), False, None)])
def test_wheels_that_get_less_than_a_step_of_the_board_are_reported_with_advice(commanded, duties, closed_loop, advice):
    robot = Mock(**{"left_motor.value": commanded, "right_motor.value": 0.0, "driver.closed_loop": closed_loop,
                    "driver.resolution": 0.0002})
    sentence = f"the wheels get less than one step of the board, so they do not turn: {advice}"
    assert str(too_slow_note(robot, duties)) == (sentence if advice else "None")


DRIVING = State(1.0, cause=None)
NOTED = Status(DRIVING, notes=(remark("full_power"),), waiting=("/circle",))


@pytest.mark.parametrize("status, text, warning", [
    (Status(DRIVING), "driving", False),
    (NOTED, "driving, both wheels at full power, /circle waits for the cockpit", True),
    (NOTED._replace(notes=()), "driving, /circle waits for the cockpit", False),
    (NOTED._replace(state=State(1.0, cause=because("nobody"), alarm=True)),
     "stopped: nobody is left to send commands, /circle waits for the cockpit", True),
    (NOTED._replace(state=DRIVING.hold(EMERGENCY_STOP, True)), "stopped: emergency stop",
     True)])
def test_a_status_has_notes_and_a_remark_where_they_matter(status, text, warning):
    assert (status.text, status.warning) == (text, warning)
    assert ", ".join([sentence(status.cause), *map(str, status.data.remarks)]) == text, "a page says the same"


def test_a_status_is_reported_once_and_looked_at_again_when_something_changes_or_after_a_while(supervisor):
    statuses, looked = [], []
    supervisor.robot = Mock(at_full_power=False, **{"driver.resolution": 0.0002})
    supervisor.robot.driver.configure_mock(resets=0, overwritten=0)
    supervisor.faults = 0
    line = StatusWatch(supervisor, lambda status: statuses.append(status.text), looked.append)
    driving = supervisor.state.command(0.1, 0.0, Sender("/pupil"), now=0.0)
    stopped = driving.command(0.0, 0.0, Sender("/pupil"), now=0.15)
    for now, state in (0.0, driving), (0.1, driving), (0.15, stopped), (0.16 + LOOK_INTERVAL, stopped):
        line(Step(now, state, None, state.speeds, (0.1, 0.1)))
    assert statuses == ["driving", "stopped: the command is zero"]
    assert looked == [0.0, 0.15, 0.16 + LOOK_INTERVAL]
