"""Several robots: they come and go while the page is open, a teacher commands each, and the map shows them."""

import math

from .conftest import OTHER_ROBOT, ROBOT

VISITOR = "visitor"
ROW = f"#fleet li[data-robot='/{OTHER_ROBOT}']"


def test_a_robot_that_comes_and_goes(page, world):
    visitor = world.publish_status(VISITOR, "<img src=x>")
    page.choose(VISITOR)
    page.wait_for_text("status", "<img src=x>")
    assert not page.run("return document.querySelectorAll('img').length"), "a status is text"
    world.kill(visitor)
    page.wait_for_text("status", "does not answer")
    page.choose(ROBOT)
    world.drive(page, ROBOT)


def test_a_teacher_stops_and_releases_one_robot(page, pupil, world):
    pupil.choose(OTHER_ROBOT)
    world.drive(pupil, OTHER_ROBOT)
    page.element("show-fleet").click()
    with world.stops(OTHER_ROBOT, what="a click on its Stop in the list", page=page):
        page.click(f"{ROW} .stop-one")
    pupil.wait_for_text("status", "its own emergency stop")
    page.wait_for(lambda: page.text_of(f"{ROW} .stop-one") == "Release", "the button to offer a release")
    page.element("show-fleet").click()
    world.drive(page, ROBOT)
    page.element("show-fleet").click()
    page.click(f"{ROW} .stop-one")
    page.wait_for(lambda: page.text_of(f"{ROW} .stop-one") == "Stop", "the button to offer a stop")
    world.stay_stopped(OTHER_ROBOT)
    pupil.lift()
    world.drive(pupil, OTHER_ROBOT)


def test_a_teacher_chooses_a_robot_in_the_list_and_puts_it_or_all_back(page, world):
    page.element("show-fleet").click()
    page.click(f"{ROW} .choose")
    page.element("show-fleet").click()
    assert page.run("return document.getElementById('robot').value") == f"/{OTHER_ROBOT}"
    for robot in OTHER_ROBOT, ROBOT:
        page.choose(robot)
        world.drive_until(lambda: distance(page) > 0.3, "the robot to drive away", page, robot)
        page.lift()
        world.wait_for_stop(robot)
        if robot == OTHER_ROBOT:
            page.element("reset").click()
        else:
            page.element("show-fleet").click()
            page.element("reset-all").click()
            page.element("show-fleet").click()
        page.wait_for(lambda: distance(page) < 0.01, "the robot to be put back")


def distance(page):
    """Return how far the chosen robot is from its start, as the map tells a screen reader."""
    words = page.element("map").get_attribute("aria-label").replace("−", "-").replace(",", "").split()
    return math.hypot(*(float(words[words.index(axis) + 1]) for axis in "xy"))


def test_the_map_follows_the_robot_or_not_and_zooms(page, world):
    page.wait_for(lambda: page.robot_on_map(), "the robot on the map")
    if page.element("follow").get_attribute("aria-pressed") == "false":  # it shows all robots first
        page.element("follow").click()
    small = page.robot_on_map().size
    page.element("zoom-in").click()
    page.wait_for(lambda: page.robot_on_map().size > 1.1 * small, "a larger robot")
    page.element("zoom-out").click()
    page.wait_for(lambda: page.robot_on_map().size < 1.05 * small, "a smaller robot")
    start = distance(page)
    world.drive_until(lambda: abs(distance(page) - start) > 0.2, "the robot to drive", page, ROBOT)
    assert page.robot_on_map().offset < 30, "the robot is in the middle"
    page.lift()
    x, y = page.place_of("#map")
    page.touch_event("touchStart", (x - 20, y))
    page.touch_event("touchMove", (x - 60, y))
    page.touch_event("touchMove", (x - 80, y))
    page.lift()
    assert page.element("follow").get_attribute("aria-pressed") == "false"
    page.wait_for(lambda: page.robot_on_map().offset > 30, "the map to be moved by the finger")
    before = page.robot_on_map().offset
    world.drive_until(lambda: abs(page.robot_on_map().offset - before) > 10, "it to move on the map", page, ROBOT)
    page.element("follow").click()
    page.wait_for(lambda: page.robot_on_map().offset < 30, "the map to follow")
