"""What a page is sent of a camera: the newest picture, within what it acknowledges; with a clock turned by hand."""

import json

import pytest
from cockpit_control import FakeCameras
from test_cockpit_pages import NO_CODES, Control, Page

from jetbot_cockpit.session.feed import ANSWER_TIMEOUT, MAX_TOTAL_FPS, PART, Picture
from jetbot_cockpit.session.messages import MAX_RATE
from jetbot_cockpit.session.pages import Pages
from jetbot_cockpit.session.protocol import PICTURE_INTERVAL
from jetbot_cockpit.session.rights import PUPIL, TEACHER
from jetbot_cockpit.session.viewers import PageOwner


class Looker(Page):
    """A page that looks at a camera. answers: whether it acknowledges what it is sent."""

    def __init__(self, pages, robot="/red", role=TEACHER, own=None, answers=True):
        super().__init__()
        self.pages, self.answers, self.waits, self.parts = pages, answers, False, []
        self.viewer = pages.join(self, role, own, PageOwner(role, "10.0.0.1"), 0.0)
        self.look(robot)

    def look(self, robot, now=0.0):
        self.pages.receive(self.viewer, json.dumps({"type": "look", "robot": robot}), now)

    def send(self, message):
        if isinstance(message, bytes):
            self.parts[-1].append(message)
            self.waits = True
        else:
            super().send(message)
            if self.sent[-1]["type"] == "picture":
                self.parts.append([])

    def acknowledge(self, now):
        if self.waits:
            self.waits = False
            number = [message["number"] for message in self.sent if message["type"] == "picture"][-1]
            self.pages.receive(self.viewer, json.dumps({"type": "seen", "number": number}), now)

    @property
    def seen(self):
        return [b"".join(parts) for parts in self.parts]


class Scene:
    """Pages, and cameras that have a new picture each 50 ms. size: of a picture, in bytes."""

    def __init__(self):
        self.cameras, control = FakeCameras(), Control()
        control.names = ["/red", "/blue"]
        self.pages, self.time, self.size = Pages(control, NO_CODES, self.cameras), 0.0, 10

    def expose(self, number):
        jpeg = b"%d" % number
        self.cameras.pictures = {name: Picture(jpeg.rjust(self.size), self.time, self.time)
                                 for name in ("/red", "/blue")}

    def run(self, seconds, *pages):
        """Let the time pass; the pages acknowledge at once."""
        for step in range(round(seconds / PICTURE_INTERVAL)):
            self.time += PICTURE_INTERVAL
            if step % 5 == 0:
                self.expose(step)
            self.pages.send_pictures(self.time)
            for page in pages:
                if page.answers:
                    page.acknowledge(self.time)


@pytest.fixture
def scene():
    return Scene()


def test_a_page_sees_fifteen_pictures_a_second_and_fifteen_pages_see_five_each(scene):
    page = Looker(scene.pages)
    scene.run(10, page)
    assert 140 <= len(page.seen) <= 151
    others = [page, *(Looker(scene.pages) for _ in range(14))]
    before = [len(each.seen) for each in others]
    scene.run(10, *others)
    assert all(48 <= len(each.seen) - earlier <= 51 for each, earlier in zip(others, before))
    assert sum(len(each.seen) for each in others) - sum(before) <= 10 * MAX_TOTAL_FPS + len(others)


def test_a_page_that_acknowledges_nothing_has_one_picture_on_its_way_and_then_gets_the_newest(scene):
    page = Looker(scene.pages, answers=False)
    scene.run(3, page)
    assert page.seen == [b"0".rjust(10)]
    page.acknowledge(scene.time)
    scene.pages.send_pictures(scene.time)
    assert page.seen[1:] == [scene.cameras.pictures["/red"].jpeg]


def test_a_large_picture_goes_in_parts_so_that_a_state_waits_behind_one_part_at_most(scene):
    scene.size = 3 * PART + 1
    page = Looker(scene.pages, answers=False)
    for part in range(1, 5):
        scene.run(0.2, page)
        assert [len(parts) for parts in page.parts] == [part]
        page.acknowledge(scene.time)
    assert len(page.seen[0]) == scene.size and max(map(len, page.parts[0])) == PART


def test_nothing_is_sent_into_a_socket_that_still_holds_something(scene):
    page = Looker(scene.pages)
    page.backlogged = True
    scene.run(1, page)
    assert page.seen == []


def test_a_camera_is_used_only_while_a_page_looks_at_it_and_answers(scene):
    page, frozen = Looker(scene.pages), Looker(scene.pages, "/blue", answers=False)
    scene.run(1, page, frozen)
    assert scene.cameras.watched == {"/red", "/blue"}
    scene.run(ANSWER_TIMEOUT, page, frozen)
    assert scene.cameras.watched == {"/red"}
    page.look(None, scene.time)
    scene.run(0.1, page)
    assert scene.cameras.watched == set()
    page.look("/red", scene.time)
    scene.run(0.1, page)
    scene.pages.leave(page.viewer)
    scene.run(0.1)
    assert scene.cameras.watched == set()


@pytest.mark.parametrize("role, own, robot, allowed", [
    (TEACHER, None, "/red", True), (PUPIL, None, "/red", True), (PUPIL, "/red", "/red", True),
    (PUPIL, "/blue", "/red", False), (TEACHER, None, "/green", False), (TEACHER, None, "/../red", False)])
def test_who_may_drive_a_robot_sees_through_its_camera_and_nobody_else(scene, role, own, robot, allowed):
    page = Looker(scene.pages, robot, role, own)
    scene.run(1, page)
    assert bool(page.seen) is bool(scene.cameras.watched) is allowed
    assert ("notice" in page.types()) is (own == "/blue")


def test_after_a_change_of_robot_an_old_acknowledgement_counts_for_nothing(scene):
    page = Looker(scene.pages, answers=False)
    scene.run(0.1, page)
    page.look("/blue", scene.time)
    scene.run(0.1, page)
    scene.pages.receive(page.viewer, '{"type": "seen", "number": 1}', scene.time)
    scene.run(1, page)
    assert [message["robot"] for message in page.sent if message["type"] == "picture"] == ["/red", "/blue"]


def test_acknowledgements_leave_the_limit_of_messages_to_the_commands(scene):
    page = Looker(scene.pages)
    commands = 0.0
    for _ in range(500):
        scene.run(PICTURE_INTERVAL, page)
        commands += MAX_RATE * PICTURE_INTERVAL
        while commands >= 1:
            commands -= 1
            scene.pages.receive(page.viewer, '{"type": "ping", "sent": 1}', scene.time)
    assert page.closed is None
    for _ in range(60):
        scene.pages.receive(page.viewer, '{"type": "seen", "number": 1}', scene.time)
    assert page.closed[0] == 4003


def test_after_a_stop_of_all_the_pictures_pause_as_the_frames_do(scene):
    page = Looker(scene.pages)
    scene.run(1, page)
    scene.pages.receive(page.viewer, '{"type": "stop"}', scene.time)
    before = len(page.seen)
    scene.run(0.08, page)
    assert len(page.seen) == before
    scene.run(1, page)
    assert len(page.seen) > before
