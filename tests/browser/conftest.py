"""Fixtures: one world with two robots, and two browsers, for all tests; each test opens the page again."""

import shutil

import pytest

from .world import World

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
    page = browsers(1)
    page.open(world.address, ROBOT)
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
