"""What moves a robot: a finger on the pad, keys, a gamepad; each of them stops it when it ends, however it ends."""

import pytest

from jetbot.fake.motors import STOPPED

from .conftest import OTHER_ROBOT, ROBOT


def near(left, right):
    return abs(left - right) < 0.02


def test_a_finger_drives_as_far_as_it_is_from_the_centre(page, world):
    page.touch(forward=0.5)
    world.wait_for_wheels(ROBOT, lambda left, right: near(left, right) and left > 0)
    slow = world.wheels(ROBOT)[0]
    page.move(1.0, 0.0)
    world.wait_for_wheels(ROBOT, lambda left, right: near(left, right) and left > 1.5 * slow)
    page.move(0.7, 0.3)
    world.wait_for_wheels(ROBOT, lambda left, right: 0 <= left < right)
    page.move(-0.7, 0.0)
    world.wait_for_wheels(ROBOT, lambda left, right: near(left, right) and left < 0)
    assert world.wheels(OTHER_ROBOT) == STOPPED


def test_a_finger_that_lifts_stops_the_robot_and_others_may_command_it(page, world):
    page.touch()
    world.wait_for_motion(ROBOT)
    assert world.publishers(ROBOT)
    page.lift()
    world.wait_for_stop(ROBOT)
    world.wait_for(lambda: not world.publishers(ROBOT), 5.0, "the cockpit to unregister cmd_vel")


ENDS = {
    "the system takes the touch": lambda page: page.touch_event("touchCancel"),
    "the window loses the focus": lambda page: page.run("window.dispatchEvent(new Event('blur'))"),
    "another tab is in front": lambda page: page.new_tab(),
    "the tab shows another page": lambda page: page.leave(),
    "the tab is closed": lambda page: page.close_tab(),
}


@pytest.mark.parametrize("end", ENDS.values(), ids=ENDS)
def test_the_robot_stops_when(end, page, world):
    page.touch()
    world.wait_for_motion(ROBOT)
    end(page)
    world.wait_for_stop(ROBOT)
    world.stays_stopped(ROBOT)


def test_a_finger_that_stayed_on_the_pad_must_lift_after_another_tab_was_in_front(page, world):
    page.touch()
    world.wait_for_motion(ROBOT)
    page.new_tab()
    world.wait_for_stop(ROBOT)
    page.old_tab()
    page.move(0.8, 0.1)
    world.stays_stopped(ROBOT)
    page.lift()
    page.touch()
    world.wait_for_motion(ROBOT)


def test_a_second_finger_on_the_pad_changes_nothing(page, world):
    page.touch()
    world.wait_for_motion(ROBOT)
    page.touch_event("touchStart", page.on_pad(1, 0), page.on_pad(-1, 0))
    world.stays(ROBOT, lambda left, right: left > 0 and right > 0)


KEYS = {
    "ArrowUp": lambda left, right: near(left, right) and left > 0,
    "w": lambda left, right: near(left, right) and left > 0,
    "ArrowDown": lambda left, right: near(left, right) and left < 0,
    "s": lambda left, right: near(left, right) and left < 0,
    "ArrowLeft": lambda left, right: left < 0 < right,
    "a": lambda left, right: left < 0 < right,
    "ArrowRight": lambda left, right: right < 0 < left,
    "d": lambda left, right: right < 0 < left,
}


@pytest.mark.parametrize("key", KEYS)
def test_a_key_drives_until_it_is_let_go(key, page, world):
    page.press(key)
    world.wait_for_wheels(ROBOT, KEYS[key])
    page.let_go(key)
    world.wait_for_stop(ROBOT)


def test_a_key_whose_release_the_page_never_sees(page, world):
    page.press("ArrowUp")
    world.wait_for_motion(ROBOT)
    page.new_tab()
    page.let_go("ArrowUp")
    world.wait_for_stop(ROBOT)
    page.old_tab()
    world.stays_stopped(ROBOT)
    page.press("ArrowUp")
    world.wait_for_motion(ROBOT)
    page.let_go("ArrowUp")


def test_the_slider_sets_how_fast_full_deflection_is(page, world):
    page.slide(20)
    page.touch()
    world.wait_for_wheels(ROBOT, lambda left, right: near(left, right) and left > 0)
    slow = world.wheels(ROBOT)[0]
    page.lift()
    page.slide(100)
    page.touch()
    world.wait_for_wheels(ROBOT, lambda left, right: near(left, right) and left > 2 * slow)


def test_keys_in_a_text_field_are_text(page, world):
    name = page.element("name")
    name.clear()
    name.send_keys("wasd d")
    world.stays_stopped(ROBOT)
    assert name.get_attribute("value") == "wasd d"
    assert not world.publishers(ROBOT)


def test_a_gamepads_stick_drives(page, world):
    page.gamepad(0, -1)
    world.wait_for_wheels(ROBOT, lambda left, right: near(left, right) and left > 0)
    page.gamepad(0, 0)
    world.wait_for_stop(ROBOT)


def test_the_wheels_show_the_lessons_formula(page, world):
    page.touch(forward=0.6, left=0.2)
    world.wait_for_motion(ROBOT)
    page.wait_for_text("wheels", "x - z")
    page.wait_for(lambda: f"{world.wheels(ROBOT)[0]:.2f}" in page.text("wheels").replace("\u2212", "-"),
                  "the left wheel's speed")
