"""The messages of the cockpit's socket: what docs/protocol.md lists is understood, and nothing else."""

import json
import re
import runpy

import pytest

from conftest import ROOT
from jetbot_cockpit.session import messages, protocol
from jetbot_cockpit.session.protocol import Message, ProtocolError, parse

SOCKET, _, KEPT = (ROOT / "docs/protocol.md").read_text().partition("## Programs that are kept")
FROM_PAGE, FROM_COCKPIT = SOCKET.split("## The page sends")[1].split("## The cockpit sends")


@pytest.mark.parametrize("fields", [
    {"type": "drive", "robot": "/", "forward": 0.5, "left": -1}, {"type": "take", "robot": "/jetbot_01"},
    {"type": "stop"}, {"type": "stop", "robot": None}, {"type": "stop", "robot": "/"},
    {"type": "release", "robot": "/"}, {"type": "reset"}, {"type": "name", "name": "Ada Łovelace"},
    {"type": "name", "name": "<b>Eve</b> + 🙂"}, {"type": "name", "name": "\U0001fadf"},  # newer than Unicode 15
    {"type": "ping", "sent": 12.5}, {"type": "codes"},
    {"type": "cameras", "on": False}, {"type": "look", "robot": "/"}, {"type": "look"}, {"type": "seen", "number": 7},
    {"type": "save", "robot": "/", "label": "free"}, {"type": "delete", "robot": "/"},
    {"type": "pupil", "robot": "/", "name": "<b>Eve</b>"}, {"type": "new_code"}, {"type": "new_code", "robot": "/"}],
    ids=str)
def test_what_a_page_sends(fields):
    assert parse(json.dumps(fields)) == Message(**fields)


@pytest.mark.parametrize("text", [
    "", "x", "null", "1", "[]", "[" * 1000, "{}", '{"type": null}', '{"type": []}', '{"type": "fly"}',
    '{"type": "stop", "other": 1}', '{"type": "stop", "robot": 1}', '{"type": "take"}',
    '{"type": "take", "robot": null}',
    '{"type": "name", "name": "a\\nb"}', '{"type": "name", "name": "\\ud800"}', '{"type": "name", "name": "\\u202eb"}',
    json.dumps({"type": "name", "name": "x" * 21}), json.dumps({"type": "stop", "robot": "x" * 1000}),
    '{"type": "ping", "sent": true}', '{"type": "ping", "sent": NaN}', '{"type": "ping", "sent": 1e999}',
    '{"type": "ping", "sent": 1%s}' % ("0" * 400), '{"type": "ping", "sent": "1"}', b'{"type": "stop"}',
    *(json.dumps({"type": "save", "robot": "/", "label": label}) for label in ("../x", "", "Free", None, ["free"])),
    *(json.dumps({"type": "pupil", "robot": "/", "name": name}) for name in ("x" * 21, "a\n", "\u202e", 7, None)),
    '{"type": "new_code", "robot": ["/"]}', '{"type": "delete"}', '{"type": "seen", "number": "7"}'],
    ids=lambda text: str(text)[:30])
def test_anything_else_is_refused(text):
    with pytest.raises(ProtocolError):
        parse(text)


@pytest.mark.parametrize("deflection", [1.01, -2, float("nan"), float("inf"), True, None, "1", [1]])
def test_a_deflection_is_a_number_from_minus_one_to_one(deflection):
    for name in "forward", "left":
        with pytest.raises(ProtocolError):
            parse(json.dumps({"type": "drive", "robot": "/", "forward": 0, "left": 0, name: deflection}))


def test_a_reason_fits_into_the_frame_that_closes_a_socket():
    for kind in [*messages.FROM_PAGE, "none"]:
        with pytest.raises(ProtocolError) as error:
            parse(json.dumps({"type": kind, "other": 1}))
        assert len(str(error.value).encode()) <= 123


def examples(text):
    """Return the JSON objects of a page's box."""
    decoder, box, found = json.JSONDecoder(), re.search(r"```json\n(.*?)```", text, re.S)[1].strip(), []
    while box:
        example, end = decoder.raw_decode(box)
        found.append(example)
        box = box[end:].strip()
    return found


def test_each_message_of_the_page_has_an_example_that_is_accepted():
    assert [protocol.parse(json.dumps(example)).type for example in examples(FROM_PAGE)] == list(messages.FROM_PAGE)


def test_each_message_of_the_cockpit_has_an_example_that_is_of_its_form():
    assert [example["type"] for example in examples(FROM_COCKPIT)] == list(messages.FROM_COCKPIT)
    assert list(filter(None, map(messages.problem_of, examples(FROM_COCKPIT)))) == []


@pytest.mark.parametrize("message, problem", [
    ({"type": "pong", "sent": "1"}, "pong.sent is not number"), ({"type": "pong"}, "pong has the fields "),
    ({"type": "pong", "sent": 1, "new": 2}, "pong has the fields sent, new"), ({"type": "new"}, "new has the fields "),
    ({"type": "trail", "robot": "/", "start": None, "points": [[0, 0], [1, float("nan")]]},
     "trail.points is not [number, number][]"),
    ({"type": "state", "emergency": False, "pupils_release": False, "unconfirmed": [],
      "robots": {"/": {"status": ""}}},
     "state.robots is not Record<string, RobotState>")])
def test_what_the_cockpit_says_in_another_form_is_named(message, problem):
    assert messages.problem_of(message) == problem


def test_the_tables_and_types_are_those_of_the_messages():
    write = runpy.run_path(str(ROOT / "docs/messages.py"))
    for file, wanted in (write["PROTOCOL"], write["documented"]), (write["TYPES"], lambda text: write["types"]()):
        text = file.read_text()
        missing = [line for line in wanted(text).splitlines() if line not in text.splitlines()]
        assert text == wanted(text), f"{file} lacks {missing}: ./morbot shell docs/messages.py"
