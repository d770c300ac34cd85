"""Several robots: they come and go while the page is open, a teacher commands each, and the map shows them."""

import math
import re

from .conftest import OTHER_ROBOT, ROBOT

VISITOR = "visitor"
ROW = f"#fleet li[data-robot='/{OTHER_ROBOT}']"


def test_a_robot_that_comes_and_goes_and_a_chosen_one_that_stays_when_it_runs_no_more(page, world):
    visitor = world.publish_status(VISITOR, "<img src=x>")
    page.choose(VISITOR)
    page.wait_for_text("status", "<img src=x>")
    assert not page.has("img"), "a status is text"
    world.kill(visitor)
    page.wait_for_text("status", "does not answer")
    page.choose(ROBOT)
    world.drive(page, ROBOT)
    page.lift()
    page.wait_for(lambda: f"/{VISITOR}" not in page.robots(), f"{VISITOR} to go")
    page.receive({"type": "robots", "robots": []})
    page.wait_for_text("status", f"{ROBOT} is not running")
    page.wait_for_text("notice", "robots are not running any more")
    assert page.robots() == {f"/{ROBOT}": f"{ROBOT} (gone)"}


def test_a_teacher_chooses_a_robot_in_the_list_and_puts_it_or_all_back(page, world):
    page.click("#show-fleet")
    page.click(f"{ROW} .choose")
    page.click("#show-fleet")
    assert page.value("robot") == f"/{OTHER_ROBOT}"
    for robot in OTHER_ROBOT, ROBOT:
        page.choose(robot)
        world.drive_until(lambda: distance(page) > 0.2, page)
        page.lift()
        world.wait_for_stop(robot)
        if robot == OTHER_ROBOT:
            page.click("#reset")
        else:
            page.click("#show-fleet")
            page.click("#reset-all")
            page.wait_for_text("reset-all", "End all programs?")
            page.click("#reset-all")
            page.click("#show-fleet")
        page.wait_for(lambda: distance(page) < 0.01, "the robot to be put back")


def distance(page):
    """Return how far the chosen robot is from its start in m, as the map tells a screen reader."""
    words = page.element("map").get_attribute("aria-label")
    return math.hypot(*map(float, re.findall(r"[\d.]+(?= m (?!away))", words)))


def test_the_map_follows_the_robot_or_not_and_zooms(page, world):
    def size():
        return page.robot_on_map()[0]

    def offset():
        return page.robot_on_map()[1]

    page.receive({"type": "trail", "robot": f"/{ROBOT}", "points": []})  # of earlier drives, in the robot's colour
    page.wait_for(page.robot_on_map, "the robot on the map")
    if page.has("#follow[aria-pressed=false]"):  # it shows all robots first
        page.click("#follow")
    small = size()
    page.click("#zoom-in")
    page.wait_for(lambda: size() > 1.1 * small, "a larger robot")
    page.click("#zoom-out")
    page.wait_for(lambda: size() < 1.05 * small, "a smaller robot")
    start = distance(page)
    world.drive_until(lambda: abs(distance(page) - start) > 0.2, page)
    assert offset() < 30, "the robot is in the middle"
    page.lift()
    x, y = page.place_of("#map")
    page.touch_event("touchStart", (x - 20, y))
    page.touch_event("touchMove", (x - 60, y))
    page.touch_event("touchMove", (x - 80, y))
    page.lift()
    assert page.has("#follow[aria-pressed=false]")
    page.wait_for(lambda: offset() > 30, "the map to be moved by the finger")
    before = offset()
    world.drive_until(lambda: abs(offset() - before) > 10, page)
    page.click("#follow")
    page.wait_for(lambda: offset() < 30, "the map to follow")
