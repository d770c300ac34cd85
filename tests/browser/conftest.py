"""Fixtures: one world with two robots, and two browsers, for all tests; each test opens the page again."""

import shutil
from contextlib import contextmanager
from functools import partial
from importlib.util import find_spec
from typing import Callable, Iterable, Iterator

import pytest

from .programs import as_file
from .world import World

TABLET = (1024, 768)  # px
ROBOT, OTHER_ROBOT = "jetbot_01", "jetbot_02"
FORGET_PROGRAMS = """for (const key of Object.keys(localStorage))
    if (key.includes("program")) localStorage.removeItem(key)"""


def some(rows: Iterable, *always) -> list:
    """Return the rows of a table as parameters, of which only these run without --long."""
    return [pytest.param(row, marks=() if row in always else pytest.mark.long) for row in rows]


def need(programs: str, packages: str) -> None:
    """Skip the test if one of these programs or modules is missing; packages: of Debian, which have them."""
    missing = [program for program in programs.split() if not (shutil.which(program) or find_spec(program))]
    if not missing:
        return
    pytest.skip(f"{' and '.join(missing)} not installed: sudo apt install {packages}")


@contextmanager
def started(start: Callable) -> Iterator[Callable]:
    """A function that returns start(key), a browser, which is started when first needed, or again if it was killed."""
    running = {}

    def browser(key):
        if key in running and not running[key].runs:
            running.pop(key).close()
        if key not in running:
            running[key] = start(key)
        return running[key]
    try:
        yield browser
    finally:
        for each in running.values():
            each.close()


@pytest.fixture(scope="session")
def browsers(tmp_path_factory):
    """A function that returns a browser by its number."""
    need("chromium chromedriver selenium", "chromium chromium-driver python3-selenium")
    from .page import Page
    with started(lambda _: Page(tmp_path_factory.mktemp("profile"))) as browser:
        yield browser


@pytest.fixture(scope="session")
def world(tmp_path_factory):
    """Two robots and a cockpit."""
    world = World(tmp_path_factory.mktemp("world"), ROBOT, OTHER_ROBOT)
    yield world
    world.close()


@pytest.fixture
def page(browsers, world):
    """A teacher's page on a phone, with ROBOT chosen; nothing drives before and after the test."""
    yield from opened(browsers(1), world, world.address)


@pytest.fixture
def blocks(browsers, world, tmp_path):
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
    world.delete_programs()
    assert not errors


@pytest.fixture
def pupil(browsers, world):
    """A pupil's page in another browser, with ROBOT chosen."""
    pupil = browsers(2)
    pupil.open(world.codes()["pupil"], ROBOT)
    pupil.run(FORGET_PROGRAMS)  # else its page for programs goes on with what a test before has left unsaved
    yield pupil
    pupil.leave()


@pytest.fixture
def victim(browsers, world):
    """That other browser, which may be frozen or killed, with a finger that drives ROBOT."""
    victim = browsers(2)
    victim.open(world.address, ROBOT)
    world.drive(victim, ROBOT)
    yield victim
    if victim.runs:
        victim.leave()
