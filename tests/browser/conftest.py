"""Fixtures: one world with two robots, and two browsers, for all tests; each test opens the page again."""

import shutil
from functools import partial

import pytest

from .programs import as_file
from .world import World

TABLET = (1024, 768)  # px
ROBOT, OTHER_ROBOT = "jetbot_01", "jetbot_02"


@pytest.fixture(scope="session")
def browsers(tmp_path_factory):
    """A function that returns a browser by its number, started when first needed, or again if it was killed."""
    pytest.importorskip("selenium", reason="selenium is not installed: sudo apt install python3-selenium")
    for program in "chromium", "chromedriver":
        if not shutil.which(program):
            pytest.skip(f"{program} is not installed: sudo apt install chromium chromium-driver")
    from .page import Page
    started = {}

    def browser(number):
        if number in started and not started[number].runs:
            started.pop(number).close()
        if number not in started:
            started[number] = Page(tmp_path_factory.mktemp("profile"))
        return started[number]
    yield browser
    for each in started.values():
        each.close()


@pytest.fixture(scope="session")
def world(browsers, tmp_path_factory):
    """Two robots and a cockpit."""
    world = World(tmp_path_factory.mktemp("world"), ROBOT, OTHER_ROBOT)
    yield world
    world.close()


@pytest.fixture
def page(world, browsers):
    """A teacher's page on a phone, with ROBOT chosen; nothing drives before and after the test."""
    yield from opened(browsers(1), world, world.address)


@pytest.fixture
def blocks(world, browsers, tmp_path):
    """A function that opens a program in the teacher's page for programs, on a tablet, and returns the page."""
    def load(content):
        page.element("file").send_keys(as_file(tmp_path, content))
        page.wait_for(lambda: not page.value("file"), "the file to be read")
        return page
    page = browsers(1)
    for _ in opened(page, world, f"{world.address}program"):
        page.screen(*TABLET)
        load.undisturbed = partial(world.undisturbed, page)
        yield load


def opened(page, world, url):
    """Open a page; check that it logs no error, and that all robots stop after the test."""
    page.open(url, ROBOT)
    page.send({"type": "go_on", "robot": None})  # what an earlier test's stop holds
    page.errors()
    yield page
    errors = page.errors()
    page.run("document.querySelectorAll('#release, .stop-one[data-action=release]').forEach(each => each.click())")
    page.leave()
    for robot in world.robots:
        world.wait_for_stop(robot)
    assert not errors


@pytest.fixture
def pupil(world, browsers):
    """A pupil's page in another browser, with ROBOT chosen."""
    pupil = browsers(2)
    pupil.open(world.codes()["pupil"], ROBOT)
    yield pupil
    pupil.leave()


@pytest.fixture
def victim(world, browsers):
    """That other browser, which may be frozen or killed, with a finger that drives ROBOT."""
    victim = browsers(2)
    victim.open(world.address, ROBOT)
    world.drive(victim, ROBOT)
    yield victim
    if victim.runs:
        victim.leave()
