"""Everybody who watches can stop every robot."""

import time

import pytest

from jetbot.fake.motors import STOPPED

from .conftest import OTHER_ROBOT, ROBOT


def wait_for_release(page):
    page.wait_for_text("status", "emergency stop was released")


def test_the_button_stops_all_robots_and_release_lets_none_start_by_itself(page, pupil, world):
    pupil.choose(OTHER_ROBOT)
    world.drive(page, ROBOT)
    world.drive(pupil, OTHER_ROBOT)
    start = time.monotonic()
    pupil.element("stop").click()
    world.wait_for(lambda: all(world.wheels(robot) == STOPPED for robot in world.robots), 1.0, "all wheels to stop")
    print(f"stop to all wheels: {1000 * (time.monotonic() - start):.0f} ms after WebDriver's click began")
    for each in page, pupil:
        each.wait_for_text("status", "emergency stop")
    page.element("release").click()
    wait_for_release(page)
    for robot in world.robots:
        world.stays_stopped(robot)
    world.drive(page, ROBOT)


@pytest.mark.parametrize("key", ["Escape", "Space"])
def test_a_key_stops_and_what_is_still_held_does_not_drive_after_the_release(key, page, world):
    world.hold(lambda: page.press("ArrowUp"), lambda: page.let_go("ArrowUp"), ROBOT)
    page.press(key)
    world.wait_for_stop(ROBOT)
    page.let_go(key)
    page.wait_for_text("status", "emergency stop")
    page.element("release").click()
    wait_for_release(page)
    world.stays_stopped(ROBOT)
    page.let_go("ArrowUp")


def test_an_emergency_stop_from_ros(page, world):
    world.emergency_stop()
    page.wait_for_text("status", "emergency stop")
    page.touch()
    world.stays_stopped(ROBOT)
    page.lift()
    world.emergency_stop("--release")
    wait_for_release(page)
