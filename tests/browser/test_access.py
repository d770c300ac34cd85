"""Who comes from another computer needs a code."""

import pytest

from .conftest import ROBOT
from .world import World


@pytest.fixture(scope="module")
def empty_world(browsers, tmp_path_factory):
    """A cockpit without a robot."""
    world = World(tmp_path_factory.mktemp("empty_world"))
    yield world
    world.close()


def test_the_code_leaves_the_address_bar_and_the_cookie_outlives_a_reload(pupil, world):
    where = world.codes()["pupil"].partition("#")[0]
    assert pupil.run("return location.href") == where
    pupil.open(where, ROBOT)
    world.drive(pupil, ROBOT)
    pupil.lift()
    assert not pupil.run("return document.cookie"), "no script reads the cookie"


def test_without_a_robot_the_page_says_so(empty_world, browsers):
    page = browsers(1)
    page.open(empty_world.address)
    page.wait_for_text("status", "no robot")
    page.leave()


def test_wrong_codes_are_refused_and_after_five_the_right_one_too(empty_world, browsers):
    page, codes = browsers(1), empty_world.codes()
    page.driver.get(codes["pupil"].partition("#")[0] + "#WRONG2")
    page.wait_for_text("login", "code")
    page.wait_for(lambda: "wrong" in page.everything(), "a sentence about the wrong code")
    for _ in range(4):
        page.log_in("WRONG3")
    page.log_in(codes["pupil"].partition("#")[2])
    page.wait_for(lambda: "minute" in page.everything(), "a sentence about too many tries")
    page.leave()
    page.errors()
