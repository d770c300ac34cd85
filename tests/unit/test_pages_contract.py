"""What everything that serves pages does, a cockpit and a hub: what pages are sent, and when one is disconnected.

With sockets and a clock that are turned by hand; what only one of the two does: test_cockpit_pages.py, test_hub.py.
"""

import time
from types import SimpleNamespace

import pytest
from cockpit_control import FakeCameras
from remote_links import FakeLink, FakeRobot, make_fleet
from test_cockpit_pages import NO_CODES, PING, STOP, Control, Page

from jetbot_cockpit.remote import hub as hubs
from jetbot_cockpit.session import pages as cockpits
from jetbot_cockpit.session import protocol
from jetbot_cockpit.session.messages import LIMITS, MAX_BURST
from jetbot_cockpit.session.rights import TEACHER
from jetbot_cockpit.session.viewers import ABSENT_AFTER, PageOwner

DRIVE = '{"type": "drive", "robot": "/ada", "forward": 1, "left": 0}'


class OfCockpit:
    """The pages of the robot ada."""

    room, gone_after = cockpits.MAX_CLIENTS, cockpits.GONE_AFTER

    def __init__(self, folder):
        self.control = Control()
        self.control.names = ["/ada"]
        self.pages = cockpits.Pages(self.control, NO_CODES, FakeCameras())

    def change(self):
        """Let the robot report something new."""
        self.control.speed += 1

    def say(self):
        """Let something happen that each page is told once."""
        self.control.messages = [{"type": "trail", "robot": "/ada", "start": None, "points": []}]

    def is_stopped(self):
        return any(message.type == "stop" for _, message in self.control.asked)

    def is_driven(self):
        return any(message.moves for _, message in self.control.asked)

    def left(self):
        """Return how many pages' robots were stopped as their page is gone."""
        return len(self.control.left)


class OfHub:
    """The pages of a hub that is connected to the robot ada."""

    room, gone_after = hubs.MAX_PAGES, hubs.GONE_AFTER

    def __init__(self, folder):
        FakeLink.made = []
        self.robot = FakeRobot("ada")
        self.pages = hubs.Hub(make_fleet(folder, "ada"), SimpleNamespace(rows=[]), FakeLink)
        self.pages.tick(0.0)
        self.connect()

    def connect(self):
        """Let all links that were made meanwhile be there."""
        for link in FakeLink.made:
            if not link.robot and not link.closed:
                assert link.connect(self.robot)
        FakeLink.made[0].report()

    def change(self):
        message = self.robot.state()
        message["robots"]["/ada"]["status"] = f"changed {time.monotonic()}"
        FakeLink.made[0].say(message)

    def say(self):
        FakeLink.made[0].say({"type": "trail", "robot": "/ada", "start": None, "points": []})

    def is_stopped(self):
        return self.robot.stopped

    def is_driven(self):
        return any(message["type"] == "drive" for message in self.robot.commands)

    def left(self):
        return sum(link.closed for link in FakeLink.made if not link.frames)


@pytest.fixture(params=[OfCockpit, OfHub], ids=["cockpit", "hub"])
def server(request, tmp_path):
    return request.param(tmp_path)


def join(server, now=0.0, shown=True, number=1):
    """Return a new page and its viewer. shown: it has been sent all that there is; number: of its address."""
    page = Page()
    viewer = server.pages.join(page, TEACHER, None, PageOwner("teacher", f"10.0.0.{number}"), now)
    if shown and viewer:
        server.pages.tick(now)
        if isinstance(server, OfHub):
            server.connect()
            server.pages.tick(now + 0.01)
        page.types()
    return page, viewer


def run(server, viewers, since, until):
    """Let the time pass; the browsers of these viewers answer pings."""
    for number in range(int(since / protocol.FRAME_INTERVAL) + 1, int(until / protocol.FRAME_INTERVAL) + 1):
        server.pages.tick(number * protocol.FRAME_INTERVAL)
        for viewer in viewers if number % 20 == 0 else ():
            server.pages.record_activity(viewer, number * protocol.FRAME_INTERVAL)


def test_a_new_page_is_told_who_it_is_and_then_sent_all_that_it_shows(server):
    page, _ = join(server, shown=False)
    server.pages.tick(0.0)
    hello, *others = page.sent
    assert {**hello, "codes": None} == {"type": "hello", "id": 1, "name": "teacher 1", "role": TEACHER, "robot": None,
                                        "codes": None, "limits": LIMITS}
    assert {"robots", "state"} <= {message["type"] for message in others}


def test_frames_are_sent_only_while_something_changes_and_once_a_second(server):
    page, viewer = join(server)
    run(server, [viewer], 0, 1)
    page.types()
    run(server, [viewer], 1, 5)
    assert 3 <= len(page.types()) <= 5
    for number in range(20):
        server.change()
        server.pages.tick(5 + number * protocol.FRAME_INTERVAL)
    assert page.types() == ["state"] * 20


def test_a_page_that_takes_nothing_is_skipped_and_then_gets_all_again(server):
    page, _ = join(server)
    page.backlogged = True
    server.change()
    server.say()
    server.pages.tick(0.05)
    assert page.types() == []
    page.backlogged = False
    server.pages.tick(0.1)
    assert page.types() == ["robots", "trail", "state"]


def test_a_page_that_says_nothing_is_sent_nothing_that_would_be_old_when_it_arrives(server):
    page, viewer = join(server)
    run(server, [], 0, ABSENT_AFTER)
    page.types()
    server.change()
    run(server, [], ABSENT_AFTER, 10)
    assert page.types() == [] and page.pings >= 5
    server.pages.record_activity(viewer, 10.0)
    server.pages.tick(10.05)
    assert "state" in page.types()


def test_a_page_that_says_nothing_for_long_is_disconnected_and_its_robot_stops(server):
    (gone, _), (here, viewer) = join(server), join(server)
    run(server, [viewer], 0, server.gone_after + 1)
    assert gone.closed == (4004, "no sign of life") and here.closed is None
    assert server.left() == 1


def test_a_ping_is_answered_to_the_page_that_asked_unless_it_takes_nothing(server):
    (page, viewer), (other, _) = join(server), join(server)
    server.pages.receive(viewer, PING, 0.0)
    assert page.sent == [{"type": "pong", "sent": 7}] and other.sent == []
    page.backlogged = True
    server.pages.receive(viewer, PING, 0.0)
    assert len(page.sent) == 1, "replies do not pile up"


@pytest.mark.parametrize("text", [
    "x", "{}", "[]", b"x", "stop", '{"type": "stop"', '{"type": "stop", "robot": 7}', '{"type": "stop"}}'])
def test_a_message_of_another_form_ends_the_socket_and_commands_nothing(server, text):
    page, viewer = join(server)
    server.pages.receive(viewer, text, 0.0)
    assert page.closed[0] == 4000 and server.left() == 1
    server.pages.receive(viewer, DRIVE, 0.0)
    assert not server.is_driven() and not server.is_stopped()


def test_what_a_page_commands_reaches_the_robot(server):
    _, viewer = join(server)
    server.pages.receive(viewer, DRIVE, 0.0)
    assert server.is_driven()


@pytest.mark.parametrize("text", [STOP, '{"type":"stop","robot":null}', '{"robot":null,"type":"stop"}',
                                  ' { "type" : "s\\u0074op" } '])
def test_a_stop_counts_also_in_a_flood_that_ends_the_socket(server, text):
    page, viewer = join(server)
    for _ in range(MAX_BURST):
        server.pages.record_activity(viewer, 0.0)
    assert page.closed is None
    server.pages.receive(viewer, text, 0.0)
    assert server.is_stopped() and page.closed[0] == 4003 and server.left() == 1


@pytest.mark.parametrize("rate, count, closed", [(40, 400, False), (50, 400, True), (1e9, 50, False), (1e9, 51, True)])
def test_forty_messages_a_second_and_what_a_pause_held_back_are_within_the_limit(server, rate, count, closed):
    page, viewer = join(server)
    for number in range(count):
        server.pages.receive(viewer, PING, 60.0 + number / rate)
    assert bool(page.closed) is closed


def test_a_closed_page_leaves_its_robot(server):
    _, viewer = join(server)
    server.pages.leave(viewer)
    assert server.left() == 1
    server.pages.leave(viewer)
    assert server.left() == 1


def test_there_is_room_for_so_many_pages(server):
    pages = [join(server, number=number, shown=False)[0] for number in range(server.room + 1)]
    assert [page.closed[0] for page in pages if page.closed] == [4002] and pages[-1].closed


def test_at_the_end_all_pages_are_disconnected_and_their_robots_stop(server):
    here = [join(server)[0] for _ in range(3)]
    server.pages.close()
    assert [page.closed[0] for page in here] == [1001] * 3 and server.left() == 3
