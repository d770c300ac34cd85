"""Everybody who watches can stop every robot."""

import pytest

from .conftest import OTHER_ROBOT, ROBOT


def wait_for_release(page):
    page.wait_for_text("status", "emergency stop was released")


def test_a_pupils_button_stops_all_robots_and_release_lets_none_start_by_itself(page, pupil, world):
    pupil.choose(OTHER_ROBOT)
    world.drive(page, ROBOT)
    world.drive(pupil, OTHER_ROBOT)
    stop = pupil.element("stop")
    with world.stops(ROBOT, OTHER_ROBOT, what="a pupil's click on STOP", page=pupil):
        stop.click()
    for each in page, pupil:
        each.wait_for_text("status", "emergency stop")
    page.element("release").click()
    wait_for_release(page)
    world.stay_stopped(ROBOT, OTHER_ROBOT)
    page.lift()
    world.drive(page, ROBOT)


def test_a_teachers_stop_is_released_by_a_teacher_only(page, pupil, world):
    page.element("stop").click()
    pupil.wait_for_text("status", "emergency stop")
    pupil.element("release").click()
    pupil.wait_for_text("notice", "teacher")
    pupil.touch()
    world.stay_stopped(ROBOT)
    pupil.lift()
    page.element("release").click()
    wait_for_release(pupil)
    world.drive(pupil, ROBOT)


@pytest.mark.parametrize("key", ["Escape", "Space"])
def test_a_key_stops_and_what_is_still_held_does_not_drive_after_the_release(key, page, world):
    world.hold(page, lambda: page.press("ArrowUp"), lambda: page.let_go("ArrowUp"), ROBOT)
    with world.stops(ROBOT, what=key, page=page):
        page.press(key)
    page.let_go(key)
    page.wait_for_text("status", "emergency stop")
    page.element("release").click()
    wait_for_release(page)
    world.stay_stopped(ROBOT)
    page.let_go("ArrowUp")


def test_an_emergency_stop_from_ros(page, world):
    world.emergency_stop()
    page.wait_for_text("status", "emergency stop")
    page.touch()
    world.stay_stopped(ROBOT)
    page.lift()
    world.emergency_stop("--release")
    wait_for_release(page)
