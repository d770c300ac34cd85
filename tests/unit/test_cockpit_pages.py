"""What only the pages of a cockpit are sent, beside test_pages_contract.py; with a clock turned by hand."""

import json
import math
from types import SimpleNamespace

import pytest
from cockpit_control import FakeCameras

from jetbot_cockpit.notices import say
from jetbot_cockpit.robots.recording import MAX_ROWS, Recording
from jetbot_cockpit.session import protocol
from jetbot_cockpit.session.messages import MAX_BURST
from jetbot_cockpit.session.pages import FLOOD_PAUSE, MAX_CLIENTS, TOO_MANY, Pages
from jetbot_cockpit.session.rights import PUPIL, TEACHER
from jetbot_cockpit.session.viewers import PageOwner

STOP = '{"type": "stop"}'
DRIVE = '{"type": "drive", "robot": "/", "forward": 1, "left": 0}'
PING = '{"type": "ping", "sent": 7}'
CODES = [{"code": "ABC234"}]
NO_CODES = SimpleNamespace(rows=[])
TRAIL = {"type": "trail", "robot": "/", "start": [0, 0, 0], "points": [[0, 0]]}


class Page:
    """A socket that notes what it is sent. backlogged: nothing more fits in."""

    def __init__(self):
        self.sent, self.pings, self.closed, self.backlogged = [], 0, None, False

    def send(self, text):
        self.sent.append(json.loads(text))

    def ping(self):
        self.pings += 1

    def close(self, code, reason):
        self.closed = code, reason

    def is_backlogged(self):
        return self.backlogged

    def types(self):
        """Return the types of the messages since the last call."""
        types, self.sent = [message["type"] for message in self.sent], []
        return types


class Control:
    """Notes what it is asked for, and reports what the test sets."""

    def __init__(self):
        self.asked, self.left, self.messages, self.names, self.speed, self.reply = [], [], [], ["/"], 0, None
        self.problem, self.recording = "", Recording()

    def handle(self, client, message, now):
        self.asked.append((client.id, message))
        return self.reply

    def stop(self, client, robot):
        self.asked.append((client.id, protocol.Message("stop", robot)))
        return self.reply

    def leave(self, client):
        self.left.append(client)

    def check(self, now):
        messages, self.messages = self.messages, []
        return messages

    def robots(self):
        return [{"id": name} for name in self.names]

    def history(self):
        return [TRAIL]

    def camera_refusal(self, client):
        return None

    def state(self):
        return {"type": "state", "speed": self.speed}

    def readings(self, robot, since, eyes):
        return (1000.0, self.recording.since(since)) if robot in self.names else None


@pytest.fixture
def control():
    return Control()


@pytest.fixture
def pages(control):
    return Pages(control, NO_CODES, FakeCameras())


def join(pages, role=TEACHER, now=0.0, code="", address="10.0.0.1"):
    page = Page()
    return page, pages.join(page, role, None, PageOwner(code or role, address), now)


def test_a_robot_that_comes_and_one_that_is_put_back_are_sent_to_all(pages, control):
    here = [join(pages)[0] for _ in range(2)]
    pages.tick(0.0)
    for page in here:
        page.types()
    control.names = ["/", "/jetbot_01"]
    pages.tick(0.05)
    control.messages = [{**TRAIL, "points": []}]
    pages.tick(0.1)
    assert [page.types() for page in here] == [["robots", "trail"]] * 2


def test_the_controls_reply_goes_to_the_page_that_asked(pages, control):
    (page, viewer), (other, _) = join(pages), join(pages)
    control.reply = {"type": "notice", "text": "no"}
    pages.receive(viewer, STOP, 0.0)
    assert page.types() == ["hello", "notice"] and other.types() == ["hello"]


@pytest.mark.parametrize("role, codes", [(TEACHER, CODES), (TEACHER, []), (PUPIL, CODES)])
def test_a_teacher_gets_the_codes_where_there_are_some(control, role, codes):
    pages = Pages(control, SimpleNamespace(rows=codes), FakeCameras())
    page, viewer = join(pages, role)
    assert page.sent[0]["codes"] is (role == TEACHER and bool(codes))
    pages.receive(viewer, '{"type": "codes"}', 0.0)
    assert page.sent[-1] == ({"type": "codes", "codes": codes} if role == TEACHER else
                             protocol.notice(say("teacher_codes")))


class Renewed:
    """Codes of which each can be replaced, of jetbot_07 alone."""

    rows = CODES

    def renew(self, robot):
        return "jetbot_07" if robot == "/jetbot_07" else None


NEW_CODE = '{"type": "new_code", "robot": "/jetbot_07"}'


def test_whose_code_is_replaced_is_disconnected_and_nobody_else(control):
    pages = Pages(control, Renewed(), FakeCameras())
    (teacher, viewer), (other, _) = join(pages, TEACHER), join(pages, PUPIL, code="jetbot_08")
    old = [join(pages, PUPIL, code="jetbot_07", address=address) for address in ("10.0.0.2", "10.0.0.3")]
    pages.receive(viewer, NEW_CODE, 0.0)
    assert teacher.sent[-1] == {"type": "codes", "codes": CODES}
    assert [page.closed[0] for page, _ in old] == [4001] * 2 and control.left == [3, 4], "their robots stop"
    assert teacher.closed is other.closed is None


def test_no_pupil_replaces_a_code_and_nobody_one_that_there_is_not(control):
    pages = Pages(control, Renewed(), FakeCameras())
    for role, text, code in (PUPIL, NEW_CODE, "teacher_new_code"), (TEACHER, '{"type": "new_code"}', "no_code"):
        page, viewer = join(pages, role)
        pages.receive(viewer, text, 0.0)
        assert page.sent[-1] == protocol.notice(say(code)) and page.closed is None


@pytest.mark.parametrize("text, robot", [
    (STOP, None), ('{"type":"stop","robot":null}', None), ('{"type":"stop","robot":"/red"}', "/red"),
    (' { "type" : "stop" , "robot" : "/jetbot_01" } ', "/jetbot_01"), ('{"robot":null,"type":"stop"}', None),
    ('{"type":"s\\u0074op","robot":"\\/red"}', "/red"), (STOP.ljust(1000), None)])
def test_a_stop_counts_before_the_limit_and_the_parser_also_after_a_flood_has_ended_the_socket(
        pages, control, monkeypatch, text, robot):
    monkeypatch.delattr(protocol, "parse")
    page, viewer = join(pages)
    for _ in range(MAX_BURST):
        pages.record_activity(viewer, 0.0)
    assert page.closed is None
    for count in 1, 2, 2:  # within the flood, and once more until the page knows that it is disconnected
        pages.receive(viewer, text, 0.0)
        assert control.asked == [(1, protocol.Message("stop", robot))] * count
        assert page.closed == (4003, "more than 40 messages per second") and control.left[0] == 1


def test_a_stop_waits_for_no_page_not_for_its_own_either(pages, control, monkeypatch):
    viewers, events = [join(pages)[1] for _ in range(3)], []
    control.speed, control.messages, control.reply = 1, [TRAIL], {"type": "notice", "text": "no"}
    monkeypatch.setattr(Page, "send", lambda page, text: events.append("send"))
    monkeypatch.setattr(Page, "is_backlogged", lambda page: events.append("look at a page"))
    stop = control.stop
    monkeypatch.setattr(control, "stop", lambda *asked: events.append("stop") or stop(*asked))
    pages.receive(viewers[1], STOP, 0.0)
    assert events == ["stop", "look at a page", "send"]


def flood(pages, page, viewer, now):
    for _ in range(MAX_BURST + 1):
        pages.receive(viewer, PING, now)
    assert page.closed == (4003, TOO_MANY)


def test_who_floods_may_come_back_after_a_moment_and_others_and_its_other_pages_stay(pages):
    other, _ = join(pages, PUPIL)
    flood(pages, *join(pages, PUPIL), 0.0)
    page, viewer = join(pages, PUPIL, FLOOD_PAUSE - 0.1)
    assert viewer is None and page.closed == (4003, TOO_MANY) and other.closed is None
    assert join(pages, PUPIL, 0.1, address="10.0.0.2")[1] and join(pages, PUPIL, 0.1, code="jetbot_02")[1]
    assert join(pages, PUPIL, FLOOD_PAUSE)[1]


def test_a_stop_is_passed_on_first_and_frames_a_moment_later_however_many_stops_follow(pages, control):
    page, viewer = join(pages, now=10.0)
    pages.tick(10.0)
    page.types()
    control.speed = 1
    for time in 10.0, 10.05:
        pages.receive(viewer, STOP, time)
        pages.tick(time + 0.01)
    assert len(control.asked) == 2 and page.types() == []
    pages.tick(10.1)
    assert page.types() == ["state"]


@pytest.mark.parametrize("robot, obeyed", [(None, [0, 0.7]), ("/other", [0.5, 0, 0.7])])
def test_commands_are_obeyed_a_moment_after_a_stop_of_all_but_letting_go_at_once(pages, control, robot, obeyed):
    _, viewer = join(pages, now=10.0)
    pages.receive(viewer, json.dumps({"type": "stop", "robot": robot}), 10.0)
    for time, forward in (10.0, 0.5), (10.01, 0), (10.11, 0.7):
        pages.receive(viewer, json.dumps({"type": "drive", "robot": "/", "forward": forward, "left": 0}), time)
    assert [message.forward for _, message in control.asked if message.type == "drive"] == obeyed


def test_there_is_room_for_100_pages_and_a_teacher_gets_the_place_of_the_newest_pupil(pages, control):
    here, viewers = zip(*(join(pages, PUPIL) for _ in range(100)))
    page, viewer = join(pages, PUPIL)
    assert viewer is None and page.closed[0] == 4002
    assert join(pages, TEACHER)[1]
    assert [number for number, each in enumerate(here) if each.closed] == [99] and control.left == [100]
    pages.leave(viewers[0])
    assert join(pages, PUPIL)[1]


@pytest.mark.parametrize("others", [
    [{"code": f"jetbot_{number:02d}"} for number in range(1, 16)],  # a code for each robot, or one for all pupils
    [{"address": f"10.0.0.{number}"} for number in range(1, 16)]])
def test_one_phone_that_takes_all_places_keeps_out_no_other(pages, others):
    first, *later = [join(pages, PUPIL, **owner)[0] for owner in others[:-1]]
    taken = [join(pages, PUPIL, **others[0])[0] for _ in range(MAX_CLIENTS - len(others) + 1)]
    for role, owner in (PUPIL, others[-1]), (PUPIL, others[5]), (TEACHER, {"address": "10.0.0.99"}):
        page, viewer = join(pages, role, **owner)
        assert viewer and not page.closed
    assert [page.closed[0] for page in taken if page.closed] == [4002] * 3 == [page.closed[0] for page in taken[-3:]]
    assert join(pages, PUPIL, **others[0])[1] is None
    assert not [page for page in (first, *later) if page.closed]


def test_a_teacher_is_told_once_that_the_class_is_not_kept_and_when_it_is_again(pages, control):
    teacher, pupil = join(pages)[0], join(pages, PUPIL)[0]
    control.problem = say("class_not_kept", problem="full")
    for now in (0.1, 0.2):
        pages.tick(now)
    late = join(pages)[0]
    pages.tick(0.3)
    control.problem = None
    pages.tick(0.4)
    told = [[each["text"] for each in page.sent if each["type"] == "notice"] for page in (teacher, late, pupil)]
    assert told == [["The class cannot be kept: full. The cockpit tries again.", "The class is kept again."]] * 2 + [[]]


class Drawing(Page):
    """A page that draws the curves of a robot."""

    def __init__(self, pages, robot="/"):
        super().__init__()
        self.pages, self.viewer = pages, pages.join(self, TEACHER, None, PageOwner("teacher", "10.0.0.1"), 0.0)
        self.follow(robot)

    def follow(self, robot):
        self.pages.receive(self.viewer, json.dumps({"type": "curves", "robot": robot, "eyes": True}), 0.0)

    def curves(self, now=0.0):
        """Let the pages send; return the messages with what the robot has reported."""
        self.pages.tick(now)
        messages, self.sent = [message for message in self.sent if message["type"] == "curves"], []
        return messages


def test_a_page_that_asks_for_curves_gets_each_value_once_as_it_was_published(pages, control):
    page, other = Drawing(pages), Drawing(pages, robot=None)
    control.recording.add("wheels", 1.0, 0.0, 0.0, 0.0, 0.0)
    assert [message["wheels"] for message in page.curves()] == [[]], "what came before it had asked"
    control.recording.add("odom", 2.0, 0.1234567890123, 0.0, 0.0, 0.25, -1e-7)
    control.recording.add("line", 2.5, 0.10000000149011612, 0.0, 1.0)
    [message] = page.curves()
    assert protocol.problem_of(message) is None
    assert message["odom"] == [[2.0, 0.1234567890123, 0.0, 0.0, 0.25, -1e-7]]
    assert message["line"] == [[2.5, 0.10000000149011612, 0.0, 1.0]]
    assert page.curves() == [], "nothing is new"
    assert other.curves() == []


def test_a_page_knows_from_the_numbers_that_values_are_missing(pages, control):
    page = Drawing(pages)
    before = page.curves()[0]["number"]
    control.recording.add("battery", 1.0, 12.1)
    [message] = page.curves()
    assert message["after"] == before
    for second in range(MAX_ROWS + 5):
        control.recording.add("battery", second, 12.1)
    [late] = page.curves()
    assert len(late["battery"]) == MAX_ROWS
    assert late["after"] == message["number"] + 5


def test_curves_end_with_their_robot_or_when_the_page_asks_for_no_more(pages, control):
    page = Drawing(pages)
    assert len(page.curves()) == 1
    for stop in (lambda: setattr(control, "names", []), lambda: page.follow(None)):
        stop()
        control.recording.add("battery", 1.0, 12.1)
        assert page.curves() == []
        control.names = ["/"]


def test_a_value_that_no_page_can_draw_is_left_out():
    recording = Recording()
    recording.add("battery", 1.0, math.nan)
    recording.add("battery", 2.0, math.inf)
    recording.add("battery", 3.0, 12.1)
    assert recording.since(0) == (0, 1, {"battery": [(3.0, 12.1)]})
