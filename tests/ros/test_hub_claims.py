"""A stolen robot proves its own name, and lies: its hub believes nothing that it says of others, and goes on."""

import asyncio
import json
import time

import pytest

from cockpit_server import WITHIN
from jetbot.wait import wait_until
from jetbot_cockpit.notices import say
from jetbot_cockpit.web.hub_socket import HubSocket

pytest_plugins = ["hub_world"]  # its fixtures

ADA, BOB = "/ada", "/bob"
ID = "0123456789abcdef"
NAME = {"robot": ADA, "id": ID, "name": "A", "version": 99, "deleted": False, "earlier": []}
LIFT = say("driven", driver="Eve", robot="bob").fields()
GRAB = {"code": "stopped", "arguments": {}, "text": "All are stopped.", "template": "All are stopped."}
NOTHING = {"ready": True, "pose": None, "speed": None, "line": None, "command": None, "wheels": None}


class Changed:
    """A robot's cockpit, as a thief may change it.

    instead: returns what it sends in place of a message, by the message's type; None: nothing.
    """

    def __init__(self, make_robot, name):
        changed, self.instead, self.sockets, self.asked = self, {}, [], []

        class Lies(HubSocket):
            def open(self):
                self.loop = asyncio.get_running_loop()
                changed.sockets.append(self)
                super().open()

            def on_message(self, message):
                changed.asked.append(json.loads(message))
                super().on_message(message)

            def send(self, message):
                said = changed.instead.get(json.loads(message)["type"], lambda message: message)(message)
                if said is not None:
                    super().send(said)
        self.robot = make_robot(name, socket=Lies)

    def say(self, **message):
        for socket in self.sockets:
            socket.loop.call_soon_threadsafe(HubSocket.send, socket, json.dumps(message))

    def drop(self):
        """Close all sockets."""
        for socket in self.sockets:
            socket.loop.call_soon_threadsafe(socket.close)


@pytest.fixture
def ada(make_robot):
    return Changed(make_robot, "ada")


@pytest.fixture
def bob(make_robot):
    return Changed(make_robot, "bob")


@pytest.fixture
def hub(ada, bob, make_hub):
    return make_hub({"ada": ada.robot, "bob": bob.robot}, connected=2)


@pytest.fixture
def page(hub, open_page):
    return open_page(hub)


def heard(page, until):
    """Return what the page receives up to this."""
    said, ends_at = [], time.monotonic() + WITHIN
    while not said or not until(said[-1]):
        said.append(page.receive())
        assert time.monotonic() < ends_at, said[-2:]
    return said


def hears(page, sentence):
    heard(page, lambda said: said.get("text") == sentence)


def sees(page, robot=BOB, **state):
    """Wait until the robot's state has these fields."""
    heard(page, lambda said: said["type"] == "state" and state.items() <= said["robots"][robot].items())


@pytest.mark.parametrize("lie", [
    {"type": "lift", "robot": ADA, **LIFT},
    {"type": "program", "robot": ADA, **NOTHING},
    {"type": "judge", "robot": ADA, "request": "x", "refusal": None},
    {"type": "trail", "robot": ADA, "start": None, "points": []},
    {"type": "scores", "scores": [{"task": "t", "robot": "ada", "score": 100, "seconds": None, "name": ""}]},
    {"type": "scores", "scores": [{"task": "t", "robot": "bob", "score": 100, "seconds": None, "name": 100 * "x"}]},
], ids=lambda lie: lie["type"])
def test_it_says_nothing_of_another_robot(bob, page, lie):
    bob.say(**lie)
    own = [{"type": "lift", "robot": BOB, **LIFT}, {"type": "trail", "robot": BOB, "start": None, "points": []}]
    for message in own:
        bob.say(**message)
    left = [*own]
    said = heard(page, lambda said: said in left and left.remove(said) or not left)
    assert not [each for each in said if ADA in each.get("robot", "") or each["type"] == "scores"]


SENTENCES = {
    "bob: All are stopped.": GRAB, "bob: There is no picture.": say("no_picture").fields(),
    "bob: teacher 2 drives ada.": say("driven", robot="ada", driver=say("teacher", number=2)).fields(),
    "Eve drives bob.": {**LIFT, "text": "All are stopped.", "template": "All are stopped."}}


@pytest.mark.parametrize("shown", SENTENCES)
def test_a_sentence_of_its_own_has_its_name(bob, page, shown):
    bob.say(type="notice", **SENTENCES[shown])
    assert heard(page, lambda said: said["type"] == "notice")[-1]["text"] == shown


def test_its_codes_are_of_its_own_pupils_and_lead_to_it(bob, hub, page):
    row = {"label": "ada", "role": "pupil", "robot": ADA, "url": "http://thief.test/", "code": "ABC234", "rows": ["1"]}
    rows = [row, {**row, "role": "Teacher", "robot": None}, {**row, "robot": BOB, "code": "<b>"}, {**row, "robot": BOB}]
    bob.instead["codes"] = lambda message: json.dumps({"type": "codes", "codes": rows})
    page.send({"type": "codes"})
    codes = heard(page, lambda said: said["type"] == "codes" and said["codes"])[-1]["codes"]
    assert [(each["label"], each["robot"], each["url"]) for each in codes] == [
        ("bob", BOB, f"http://{bob.robot.address}/#ABC234")]
    assert codes[0]["rows"] != row["rows"]


def test_it_is_shown_by_the_name_that_it_has_proven(bob, hub):
    bob.instead["robots"] = lambda message: message.replace('"label":"bob"', '"label":"ada"')
    bob.drop()
    page = hub.page()
    rows = page.receive_until(lambda said: said["type"] == "robots" and len(said["robots"]) == 2)["robots"]
    assert [each["label"] for each in rows] == ["ada", "bob"]


NUMBERS = {"of no ping": "-1e308", "none in JSON": "1e999", "NaN": "NaN"}


@pytest.mark.parametrize("sent", NUMBERS.values(), ids=NUMBERS)
def test_an_answer_to_a_ping_that_nobody_sent_is_none(bob, hub, open_page, sent):
    bob.instead["pong"] = lambda message: f'{{"type":"pong","sent":{sent}}}'
    bob.asked.clear()
    assert wait_until(lambda: len([each for each in bob.asked if each["type"] == "ping"]) > 1, WITHIN)
    page = open_page(hub)
    assert page.receive("state")["robots"][ADA]["link"] is not None
    assert all(link.delay is None or 0 <= link.delay < WITHIN for link in hub.hub._robots.connected().values())


def test_it_answers_for_no_other_robot(ada, bob, hub, page):
    def answer_for_ada(message):
        bob.say(**{**json.loads(message), "status": 200, "body": NAME})
    ada.instead["work"] = answer_for_ada
    assert hub.work(do="open", robot=ADA, id=ID)[1]["code"] == "no_answer"


BODIES = {"no list": {"programs": 5}, "no rows": {"programs": [1, "x", None]}, "null": {"programs": None},
          "another robot's": {"programs": [NAME]}, "no programs": {}}


@pytest.mark.parametrize("status, body", [*((200, body) for body in BODIES.values()), (204, {}), (409, {})],
                         ids=[*BODIES, "an odd status", "no reason"])
def test_what_is_no_answer_hides_nobody_elses_programs(ada, bob, hub, page, status, body):
    hub.work(do="save", robot=ADA, id=ID, version=0, name="Square", program="{}")
    bob.instead["work"] = lambda message: json.dumps({**json.loads(message), "status": status, "body": body})
    answer, listed = hub.work(do="list", robot=None)
    assert (answer, [row["name"] for row in listed["programs"]]) == (200, ["Square"])
    assert hub.work(do="open", robot=BOB, id=ID)[1]["code"] == "no_answer"


def nested(levels):
    said = GRAB
    for _ in range(levels):
        said = {**GRAB, "arguments": {"a": said}}
    return said


def test_a_message_that_is_too_deep_ends_its_connection_alone(bob, hub, page):
    bob.say(type="lift", robot=BOB, **nested(300))
    hears(page, "bob sends too much: its connection was closed.")
    sees(page, answers=False)
    sees(page, answers=True)


SCENE = {"type": "scene", "robot": ADA, "shapes": [{"kind": "wall", "width": 0.01, "points": 20000 * [[1.0, 2.0]]}]}


def test_a_robot_that_sends_too_much_is_disconnected_and_the_others_are_not(hub, ada, bob):
    ada.say(**SCENE)
    assert wait_until(lambda: "ada sends too much: its connection was closed." in hub.hub.log, WITHIN), hub.hub.log
    assert BOB in hub.hub._robots.connected()
    assert hub.hub._tables.messages() == []


def test_a_trail_that_is_longer_than_documented_is_dropped(hub, ada):
    trail = {"type": "trail", "robot": ADA, "start": None}
    for points in 501, 500:
        ada.say(**trail, points=points * [[0.0, 1.0]])
    assert wait_until(lambda: hub.hub._tables.messages(), WITHIN)
    assert [len(said["points"]) for said in hub.hub._tables.messages()] == [500]


@pytest.mark.parametrize("levels", [20, 100, 150, 300])
def test_a_sentence_in_a_sentence_in_a_sentence_leaves_no_error_in_the_log(page, ada, levels, caplog):
    ada.say(type="notice", **nested(levels))
    ada.say(type="lift", robot=ADA, **nested(levels))
    ada.say(type="notice", **GRAB)
    page.receive_until(lambda said: said["type"] == "state")
    page.send({"type": "stop"})
    page.receive_until(lambda said: said["type"] == "state" and said["emergency"] and not said["unconfirmed"])
    assert [record.getMessage() for record in caplog.records if record.levelname == "ERROR"] == []
