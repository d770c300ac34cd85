"""docs/cockpit.md lists the messages and limits of the socket as they are in protocol.py."""

import json
import re

import pytest
from test_docs import rows

from conftest import ROOT
from jetbot_cockpit import protocol

PAGE = (ROOT / "docs/cockpit.md").read_text()
FROM_PAGE, FROM_COCKPIT = PAGE.split("The page sends:")[1].split("The cockpit sends:")


def table(text):
    """Return {type: fields} of a table of messages."""
    return {row[0].strip("`"): re.findall(r"`(\w+)`", row[1])
            for row in rows(text) if re.fullmatch(r"`(?!type`)\w+`", row[0])}


def examples(text):
    """Return the JSON objects of a page's box."""
    decoder, box, found = json.JSONDecoder(), re.search(r"```json\n(.*?)```", text, re.S)[1].strip(), []
    while box:
        example, end = decoder.raw_decode(box)
        found.append(example)
        box = box[end:].strip()
    return found


def test_the_messages_of_the_page():
    assert table(FROM_PAGE) == {kind: list(checks) for kind, (_, checks) in protocol.MESSAGES.items()}


def test_the_examples_of_the_page_are_accepted():
    assert [protocol.parse(json.dumps(example)) for example in examples(FROM_PAGE)]
    assert [example["type"] for example in examples(FROM_PAGE)] == list(table(FROM_PAGE))


def test_the_examples_of_the_cockpit_have_the_fields_of_the_table():
    assert {example.pop("type"): list(example) for example in examples(FROM_COCKPIT)} == table(FROM_COCKPIT)


@pytest.mark.parametrize("line", [
    f"| size of a message | {protocol.MAX_MESSAGE} bytes |", f"| messages per second | {protocol.MAX_RATE} |",
    f"what the person is called, {protocol.MAX_NAME} characters at most",
    f"in [-1, 1], forward and to the left, {protocol.DRIVE_RATE} times a second"])
def test_the_limits(line):
    assert line in PAGE
