"""What moves a robot: a finger on the pad, keys, a gamepad; each of them stops it when it ends, however it ends."""

import re

import pytest

from jetbot.fake.motors import STOPPED

from .conftest import OTHER_ROBOT, ROBOT


def forward(left, right):
    return abs(left - right) < 0.02 and left > 0


def backward(left, right):
    return abs(left - right) < 0.02 and left < 0


def turn_left(left, right):
    return left < 0 < right


def turn_right(left, right):
    return right < 0 < left


@pytest.mark.parametrize("x, z, wanted", [
    (1, 0, forward), (-1, 0, backward), (0, 1, turn_left), (0, -1, turn_right),
    (0.9, 0.3, lambda left, right: 0 < left < right)])
def test_a_finger_drives_to_where_it_is(x, z, wanted, page, world):
    world.drive(page, ROBOT, x, z, wanted)
    assert world.wheels(OTHER_ROBOT) == STOPPED


def test_a_finger_near_the_centre_drives_slowly(page, world):
    world.drive(page, ROBOT, 1.0, wanted=lambda left, right: left > 0.4)
    world.drive(page, ROBOT, 0.4, wanted=lambda left, right: 0 < left < 0.4)


def test_a_finger_that_lifts_stops_the_robot_and_others_may_command_it(page, world):
    world.drive(page, ROBOT)
    assert world.publishers(ROBOT)
    page.lift()
    world.wait_for_stop(ROBOT)
    world.wait_for(lambda: not world.publishers(ROBOT), 10.0, "the cockpit to unregister cmd_vel")


ENDS = {
    "the system takes the touch": lambda page: page.touch_event("touchCancel"),
    "the window loses the focus": lambda page: page.run("window.dispatchEvent(new Event('blur'))"),
    "another tab is in front": lambda page: page.new_tab(),
    "the tab shows another page": lambda page: page.leave(),
    "the tab is closed": lambda page: page.close_tab(),
}


@pytest.mark.parametrize("end", ENDS.values(), ids=ENDS)
def test_the_robot_stops_when(end, page, world):
    world.drive(page, ROBOT)
    end(page)
    world.wait_for_stop(ROBOT)
    world.stays_stopped(ROBOT)


def test_a_finger_that_stayed_on_the_pad_must_lift_after_another_tab_was_in_front(page, world):
    world.drive(page, ROBOT)
    page.new_tab()
    world.wait_for_stop(ROBOT)
    page.old_tab()
    page.move(0.8, 0.1)
    world.stays_stopped(ROBOT)
    world.drive(page, ROBOT)


def test_a_second_finger_on_the_pad_changes_nothing(page, world):
    world.drive(page, ROBOT)
    page.touch_event("touchStart", page.on_pad(1, 0), page.on_pad(-1, 0))
    world.stays(ROBOT, lambda left, right: left >= 0 and right >= 0)


KEYS = {"ArrowUp": forward, "w": forward, "ArrowDown": backward, "s": backward,
        "ArrowLeft": turn_left, "a": turn_left, "ArrowRight": turn_right, "d": turn_right}


@pytest.mark.parametrize("key", KEYS)
def test_a_key_drives_until_it_is_let_go(key, page, world):
    hold(key, page, world, KEYS[key])
    page.let_go(key)
    world.wait_for_stop(ROBOT)


def hold(key, page, world, wanted=forward):
    world.hold(lambda: page.press(key), lambda: page.let_go(key), ROBOT, wanted)


def test_a_key_whose_release_the_page_never_sees(page, world):
    hold("ArrowUp", page, world)
    page.new_tab()
    page.let_go("ArrowUp")
    world.wait_for_stop(ROBOT)
    page.old_tab()
    world.stays_stopped(ROBOT)
    hold("ArrowUp", page, world)
    page.let_go("ArrowUp")


def test_the_slider_sets_how_fast_full_deflection_is(page, world):
    page.set("speed", "20")
    world.drive(page, ROBOT, wanted=lambda left, right: 0.1 < left < 0.3)
    page.set("speed", "100")
    world.drive(page, ROBOT, wanted=lambda left, right: left > 0.9)


def test_keys_in_a_text_field_are_text(page, world):
    name = page.element("name")
    name.clear()
    name.send_keys("wasd d")
    world.stays_stopped(ROBOT)
    assert name.get_attribute("value") == "wasd d"
    assert not world.publishers(ROBOT)


def test_a_gamepads_stick_drives(page, world):
    world.hold(lambda: page.gamepad(0, -1), lambda: page.gamepad(0, 0), ROBOT, forward)
    page.gamepad(0, 0)
    world.wait_for_stop(ROBOT)


def test_the_wheels_show_the_lessons_formula(page, world):
    world.drive(page, ROBOT, 0.6, 0.2)
    formula = r"left = x − z = 0\.\d\d − 0\.\d\d = 0\.\d\d"
    page.wait_for(lambda: re.search(formula, page.text("wheels")), "the formula")
