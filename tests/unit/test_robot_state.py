"""~state as data: what one program writes into the message, another one reads."""

from types import SimpleNamespace

import pytest

from jetbot_ros.state import CAUSES, HOLDS, UNKNOWN, RobotState, because, read


def message(sentence, values):
    """Return what a diagnostic_msgs/DiagnosticStatus looks like."""
    return SimpleNamespace(message=sentence, values=[SimpleNamespace(key=key, value=values[key]) for key in values])


@pytest.mark.parametrize("state", [
    UNKNOWN,
    RobotState("driving", "driving", commanded_by="/circle", bus="fake:/tmp/a b"),
    RobotState("stopped", "stopped: no command for 1.0 s", "no_command", {"seconds": "1.0"}, HOLDS[:2], "/circle",
               ("/circle", "/line"), "1")])
def test_what_is_written_is_read(state):
    assert read(message(state.sentence, state.values())) == state


def test_what_any_program_publishes_is_printable_and_short():
    state = read(message("\33[2J" + 1000 * "x", {"state": "\33", "holds": 1000 * "y "}))
    assert "\33" not in state.sentence + state.state and len(state.sentence) < 400 and len(state.holds) < 400


@pytest.mark.parametrize("code", CAUSES)
def test_each_cause_has_a_sentence(code):
    cause = because(code, program="/circle", problem="no answer", seconds="1.0")
    assert str(cause).startswith("stopped: ") and "{" not in str(cause)
