"""The messages of the cockpit's socket: what is documented is understood, and nothing else."""

import json

import pytest

from jetbot_cockpit_server import protocol
from jetbot_cockpit_server.limits import TokenBucket
from jetbot_cockpit_server.protocol import ProtocolError, parse


@pytest.mark.parametrize("fields, message", [
    ({"type": "drive", "robot": "/", "forward": 0.5, "left": -1}, protocol.Drive("/", 0.5, -1)),
    ({"type": "take", "robot": "/jetbot_01"}, protocol.Take("/jetbot_01")),
    ({"type": "stop"}, protocol.Stop()),
    ({"type": "stop", "robot": None}, protocol.Stop()),
    ({"type": "stop", "robot": "/"}, protocol.Stop("/")),
    ({"type": "release", "robot": "/"}, protocol.Release("/")),
    ({"type": "reset"}, protocol.Reset()),
    ({"type": "name", "name": "Ada Łovelace"}, protocol.Name("Ada Łovelace")),
    ({"type": "name", "name": "<b>Eve</b> + 🙂"}, protocol.Name("<b>Eve</b> + 🙂")),
    ({"type": "name", "name": "\U0001fadf"}, protocol.Name("\U0001fadf")),  # newer than Unicode 15
    ({"type": "ping", "sent": 12.5}, protocol.Ping(12.5)),
    ({"type": "codes"}, protocol.Codes())])
def test_what_a_page_sends(fields, message):
    assert parse(json.dumps(fields)) == message


@pytest.mark.parametrize("text", [
    "", "x", "null", "1", "[]", "[" * 1000, "{}", '{"type": null}', '{"type": []}', '{"type": "fly"}',
    '{"type": "stop", "other": 1}', '{"type": "stop", "robot": 1}', '{"type": "take"}',
    '{"type": "take", "robot": null}',
    '{"type": "name", "name": "a\\nb"}', '{"type": "name", "name": "\\ud800"}', '{"type": "name", "name": "\\u202eb"}',
    json.dumps({"type": "name", "name": "x" * 21}), json.dumps({"type": "stop", "robot": "x" * 1000}),
    '{"type": "ping", "sent": true}', '{"type": "ping", "sent": NaN}', '{"type": "ping", "sent": 1e999}',
    '{"type": "ping", "sent": 1%s}' % ("0" * 400), '{"type": "ping", "sent": "1"}', b'{"type": "stop"}'],
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
    for kind in [*protocol.MESSAGES, "none"]:
        with pytest.raises(ProtocolError) as error:
            parse(json.dumps({"type": kind, "other": 1}))
        assert len(str(error.value).encode()) <= 123


def test_forty_messages_a_second_are_within_the_limit_and_more_are_not():
    bucket = TokenBucket(rate=40, burst=50, now=0.0)
    assert all(bucket.take(number / 40) for number in range(400))
    assert not all(bucket.take(10 + number / 50) for number in range(400))


def test_what_a_pause_of_the_network_held_back_is_within_the_limit():
    bucket = TokenBucket(rate=40, burst=50, now=0.0)
    assert [bucket.take(0.0) for _ in range(51)] == [True] * 50 + [False]
    assert [bucket.take(60.0) for _ in range(51)] == [True] * 50 + [False]
