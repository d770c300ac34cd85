"""Fixtures: one world with two robots, and two browsers, for all tests; each test opens the page again."""

import shutil
import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parents[1] / "ros"))  # harness
from .world import World  # noqa: E402

ROBOT, OTHER_ROBOT = "jetbot_01", "jetbot_02"


def pytest_collection_modifyitems(items):
    """Let one process of pytest-xdist run them all, with --dist loadgroup."""
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker(pytest.mark.xdist_group("browser"))


@pytest.fixture(scope="session")
def browsers(tmp_path_factory):
    """A function that returns a browser by its number, started when first needed."""
    pytest.importorskip("selenium", reason="selenium is not installed: sudo apt install python3-selenium")
    for program in "chromium", "chromedriver":
        if not shutil.which(program):
            pytest.skip(f"{program} is not installed: sudo apt install chromium chromium-driver")
    from .page import Page
    started = {}

    def browser(number):
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
    page.run("document.getElementById('release')?.click()")
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
