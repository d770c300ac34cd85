"""docs/cockpit.md lists the messages and limits of the socket as they are in protocol.py."""

import json
import re

import pytest
from test_docs import rows

from conftest import ROOT
from jetbot_cockpit_server import access, dead_man, hub, lease, protocol, scene, scores
from jetbot_cockpit_server.parameters import PARAMETERS

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


def test_why_a_socket_is_closed():
    codes = {int(row[0]) for row in rows(FROM_COCKPIT) if row[0].isdigit()}
    assert codes == {hub.REFUSED, hub.LOG_IN, hub.FULL, hub.ENDED}


@pytest.mark.parametrize("text", [
    f"larger than {protocol.MAX_MESSAGE} bytes",
    f"more than {protocol.MAX_RATE} messages a second (after a pause, {protocol.MAX_BURST} at once)",
    f"{hub.GONE_AFTER:.0f} s without a message", f"{hub.MAX_CLIENTS} pages are connected",
    f"what the person is called, {protocol.MAX_NAME} characters at most",
    f"the pupil's code, {access.CODE_LENGTH['pupil']} characters",
    f"the teacher's code, {access.CODE_LENGTH['teacher']} characters",
    f"after {access.MAX_WRONG_IN_ALL} from all",
    f"at most {scene.MAX_POINTS} points each", f"at most {scores.MAX_SCORES} rows",
    f"nothing came from the page for {dead_man.TIMEOUT} s", f"free {lease.TIMEOUT:.0f} s after its driver's last"])
def test_the_figures(text):
    assert text in PAGE


def test_the_launch_arguments():
    reference = {row[0].strip("`"): row[1].strip("`") for row in rows((ROOT / "docs/reference.md").read_text())}
    for name, parameter in PARAMETERS.items():
        default = reference["cockpit_port:=" if name == "port" else f"{name}:="]
        assert default == ("false" if parameter.default is False else str(parameter.default))
