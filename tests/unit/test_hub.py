"""What a hub does with a page's commands while a connection to a robot, or to the page, takes nothing."""

import json

import pytest
from remote_links import FakeLink
from test_pages_contract import DRIVE, OfHub, join

LET_GO = DRIVE.replace("1", "0", 1)
LOOK = '{"type": "look", "robot": "/ada"}'


@pytest.fixture
def hub(tmp_path):
    return OfHub(tmp_path)


def commanded(hub):
    return [message for message in hub.robot.commands if message["type"] == "drive"]


@pytest.mark.parametrize("state", ["backlogged", "stale", "frozen"])
def test_a_command_that_would_come_late_is_refused_until_the_finger_has_lifted(hub, state):
    page, viewer = join(hub)
    link = FakeLink.made[-1]
    setattr(link, state, True)
    hub.pages.receive(viewer, DRIVE, 0.0)
    assert [(said["type"], said["code"]) for said in page.sent] == [("lift", "no_answer")]
    setattr(link, state, False)
    hub.pages.receive(viewer, DRIVE, 0.0)
    assert page.sent[-1]["code"] == "let_go" and not commanded(hub)
    for text in LET_GO, DRIVE:
        hub.pages.receive(viewer, text, 0.0)
    assert commanded(hub) == [json.loads(text) for text in (LET_GO, DRIVE)]


def test_a_picture_is_left_out_for_a_page_that_takes_nothing(hub):
    page, viewer = join(hub)
    page.send = page.sent.append
    hub.pages.receive(viewer, LOOK, 0.0)
    for page.backlogged, picture in (False, b"1"), (True, b"2"), (False, b"3"):
        FakeLink.made[-1].say(picture)
    assert page.sent == [b"1", b"3"]
