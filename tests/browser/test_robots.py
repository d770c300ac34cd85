"""Robots come and go while the page is open."""

from .conftest import ROBOT

STRANGER = "stranger"


def test_a_robot_that_comes_and_goes(page, world):
    stranger = world.start_stranger(STRANGER, "<img src=x>")
    page.choose(STRANGER)
    page.wait_for_text("status", "<img src=x>")
    assert not page.run("return document.querySelectorAll('img').length"), "a status is text"
    world.kill(stranger)
    page.wait_for(lambda: f"/{STRANGER}" not in page.robots() or "answer" in page.text("status"), "the robot to go")
    page.choose(ROBOT)
    world.drive(page, ROBOT)


def test_the_map_shows_the_robot_and_moves_with_it(page, world):
    before = page.map()
    assert page.colors() > 2, "the map is empty"
    world.drive(page, ROBOT)
    page.wait_for(lambda: page.map() != before, "another picture")
