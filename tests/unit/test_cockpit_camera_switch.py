"""A teacher switches the cameras off: what pupils see and collect then, and at the class's next lesson."""

import json

import pytest
from cockpit_control import ADA, TEACHER, Cockpit
from test_cockpit_camera import Looker
from test_cockpit_pages import NO_CODES

from jetbot_cockpit.session import rights
from jetbot_cockpit.session.feed import Picture
from jetbot_cockpit.session.pages import Pages
from jetbot_cockpit.session.protocol import Message

pytest_plugins = ["cockpit_control"]  # its fixtures
OFF, ON = Message("cameras", on=False), Message("cameras", on=True)
SENTENCE = "Your teacher has switched the cameras off."


class Scene:
    """A pupil's page and a teacher's look at a robot whose camera has a new picture at each look at it."""

    def __init__(self, cockpit):
        self.cockpit, self.number = cockpit, 0
        self.pages = Pages(cockpit.control, NO_CODES, cockpit.cameras)
        self.pupil, self.teacher = (Looker(self.pages, role=role) for role in (rights.PUPIL, rights.TEACHER))

    def see(self):
        """Return how many new pictures the pupil sees, and the teacher, of two."""
        before = len(self.pupil.seen), len(self.teacher.seen)
        for _ in range(2):
            self.number += 1
            self.cockpit.cameras.pictures = {"/red": Picture(b"%d" % self.number, self.number, self.number)}
            self.pages.send_pictures(self.number)
            for page in self.pupil, self.teacher:
                page.acknowledge(self.number)
        return len(self.pupil.seen) - before[0], len(self.teacher.seen) - before[1]

    def switch(self, on):
        self.pages.receive(self.teacher.viewer, json.dumps({"type": "cameras", "on": on}), self.number)
        self.pages.tick(self.number)


@pytest.fixture
def scene(cockpit):
    return Scene(cockpit)


def told(page):
    return [message["on"] for message in page.sent if message["type"] == "cameras"]


def test_while_the_cameras_are_off_a_teacher_sees_and_no_pupil_even_one_who_looked_before(scene):
    assert scene.see() == (2, 2)
    scene.switch(on=False)
    assert scene.see() == (0, 2)
    scene.pupil.look("/red", scene.number)
    assert scene.pupil.sent[-1]["text"] == SENTENCE
    assert scene.see() == (0, 2)
    scene.switch(on=True)
    scene.pupil.look("/red", scene.number)
    assert scene.see() == (2, 2)
    assert told(scene.pupil) == told(scene.teacher) == [False, True]


def test_only_a_teacher_switches_them(cockpit):
    assert cockpit.do(ADA, OFF)["text"] == "Only a teacher switches the cameras."
    assert cockpit.control.camera_refusal(ADA) is None


def test_a_pupil_who_drives_collects_no_picture_that_it_may_not_see(tmp_path):
    cockpit = Cockpit(str(tmp_path))
    cockpit.cameras.pictures = {"/red": Picture(b"", 0.0, 0.0)}
    save = Message("save", "/red", label="free")
    assert cockpit.push(ADA) is None
    cockpit.do(TEACHER, OFF)
    assert cockpit.do(ADA, save)["text"] == SENTENCE
    cockpit.do(TEACHER, ON)
    assert cockpit.do(ADA, save) is None


@pytest.mark.parametrize("content, off", [
    ({"on": False}, True), ({"on": True}, False), (None, False), ({}, False), ({"on": 0}, False), ([False], False)])
def test_a_class_that_is_kept_keeps_it_and_any_other_content_means_on(kept, content, off):
    kept.content["cameras"] = content
    kept.set_aside = lambda name: None
    assert bool(Cockpit(folder=kept).control.camera_refusal(ADA)) is off


def test_the_switch_is_there_at_the_next_lesson(kept):
    first = Cockpit(folder=kept)
    first.do(TEACHER, OFF)
    first.settle()
    assert {"type": "cameras", "on": False} in Cockpit(folder=kept).control.history()
