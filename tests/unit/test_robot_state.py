"""~state as data: what one program writes into the message, another one reads."""

from types import SimpleNamespace

import pytest

from jetbot.sentence import MAX_SENTENCES, Sentence, dump
from jetbot_cockpit.session.snapshot import RobotSnapshot
from jetbot_ros.state import CAUSES, HOLDS, MAX_LENGTH, UNKNOWN, RobotState, because, read, sentence

EMPTY = Sentence("empty", "its battery is empty ({voltage} V)", {"voltage": "7.1"})


def message(sentence, values):
    """Return what a diagnostic_msgs/DiagnosticStatus looks like."""
    return SimpleNamespace(message=sentence, values=[SimpleNamespace(key=key, value=values[key]) for key in values])


def sent(state):
    """Return what a page gets of a robot in this state."""
    return RobotSnapshot("/", state=state).message(None, None, None, None, 0, None, 0)


@pytest.mark.parametrize("state", [
    UNKNOWN,
    RobotState("driving", "driving", commanded_by="/circle", remarks=(), bus="fake:/tmp/a b"),
    RobotState("stopped", "stopped: no command for 1.0 s", "no_command", {"seconds": "1.0"}, HOLDS[:2], "/circle",
               ("/circle", "/line"), (EMPTY,), "1")])
def test_what_is_written_is_read(state):
    assert read(message(state.sentence, state.values())) == state


def test_what_any_program_publishes_is_printable_and_short():
    state = read(message("\33[2J" + 1000 * "x", {"state": "\33", "holds": 1000 * "y "}))
    assert "\33" not in state.sentence + state.state and len(state.sentence) < 400 and len(state.holds) < 400


@pytest.mark.parametrize("code", CAUSES)
def test_each_cause_has_a_sentence(code):
    cause = because(code, program="/circle", problem="no answer", seconds="1.0")
    assert sentence(cause).startswith("stopped: ") and "{" not in sentence(cause)


def test_a_page_gets_what_it_translates_a_cause_with():
    values = {"state": "stopped", "cause": "no_command", "seconds": "1.0\33" + 1000 * "0", "more": "x"}
    state = read(message("", values))
    assert state.template == "no command for {seconds} s (repeat it: rostopic pub -r 10)"
    assert list(state.arguments) == ["seconds"] and state.arguments["seconds"][:8] == r"1.0\x1b0"
    assert len(state.arguments["seconds"]) == MAX_LENGTH
    assert (sent(state)["template"], sent(state)["arguments"]) == (state.template, state.arguments)


@pytest.mark.parametrize("values", [{"state": "driving"}, {"cause": "no_command"}, {"cause": "new", "seconds": "1"}],
                         ids=str)
def test_a_state_whose_cause_cannot_be_translated_has_its_sentence_alone(values):
    state = read(message("stopped: all the same", values))
    assert (state.template, state.arguments, state.sentence) == ("", {}, "stopped: all the same")


@pytest.mark.parametrize("values", [{}, {"remarks": ""}, {"remarks": "[" * 4000}, {"remarks": '["its battery"]'},
                                    {"remarks": dump([Sentence("", "x")] * (MAX_SENTENCES + 1))}], ids=str)
def test_remarks_that_cannot_be_translated_are_in_its_sentence_alone(values):
    state = read(message("driving, its battery is empty", {"state": "driving", **values}))
    assert (state.remarks, state.sentence, sent(state)["remarks"]) == (None, "driving, its battery is empty", None)


def test_a_page_gets_the_remarks_of_each_robot():
    state = read(message("", {"remarks": dump([EMPTY])}))
    assert sent(state)["remarks"] == [EMPTY._asdict()] and sent(state._replace(remarks=()))["remarks"] == []
