"""What moves a robot: a finger on the pad, keys, a gamepad; each of them stops it when it ends, however it ends."""

import re
import time

import pytest

from jetbot.fake.motors import STOPPED

from .conftest import OTHER_ROBOT, ROBOT

FORMULA = r"left = x − z = 0\.\d\d − 0\.\d\d = 0\.\d\d"


def forward(left, right):
    return abs(left - right) < 0.02 and left > 0


def backward(left, right):
    return abs(left - right) < 0.02 and left < 0


def turn_left(left, right):
    return left < 0 < right


def turn_right(left, right):
    return right < 0 < left


def test_the_wheels_follow_the_first_finger_and_stop_at_its_release_when_others_may_command_the_robot(page, world):
    world.drive(page, ROBOT, 1.0, wanted=lambda left, right: left == right > 0.4)
    for x, z, wanted in [(-1, 0, backward), (0, 1, turn_left), (0, -1, turn_right),
                         (0.9, 0.3, lambda left, right: 0 < left < right),
                         (0.25, 0, lambda left, right: 0 < left == right < 0.4)]:
        world.hold(page, lambda x=x, z=z: page.move(x, z), lambda: page.touch(0, 0), ROBOT, wanted)
    assert world.wheels(OTHER_ROBOT) == STOPPED
    world.hold(page, lambda: page.move(0.6, 0.2), lambda: page.touch(0, 0), ROBOT)
    page.wait_for(lambda: re.search(FORMULA, page.text("wheels")), "the lessons' formula")
    world.hold(page, lambda: page.move(1.0, 0), lambda: page.touch(0, 0), ROBOT, forward)
    assert world.publishers(ROBOT)
    page.touch_event("touchStart", page.on_pad(1, 0), page.on_pad(-1, 0))
    page.touch_event("touchMove", page.on_pad(1, 0), page.on_pad(-1, 0.2))
    world.stay(lambda left, right: left >= 0 and right >= 0, ROBOT)
    with world.stops(ROBOT, what="the release of both fingers"):
        page.lift()
    assert page.sent()[-1].is_zero
    world.wait_for(lambda: not world.publishers(ROBOT), 10.0, "the cockpit to unregister cmd_vel")


ENDS = {
    "the tab shows another page": lambda page: page.driver.get("about:blank"),
    "the tab is closed": lambda page: page.driver.close(),
}


@pytest.mark.parametrize("end", ENDS.values(), ids=ENDS)
def test_the_robot_stops_when(end, page, world, request):
    page.new_tab(f"{world.address}icon.svg")
    page.show_tab(0)
    world.drive(page, ROBOT)
    with world.stops(ROBOT, what=request.node.callspec.id):
        end(page)
    page.show_tab(-1)
    assert page.sent()[-1].is_zero


POINTER = "pad.dispatchEvent(new PointerEvent('{}', {{pointerId: window.pointer, bubbles: true}}))"
EVENTS = {  # each alone: browsers send several of them at once, or only one
    "pointercancel": POINTER.format("pointercancel"),
    "lostpointercapture": POINTER.format("lostpointercapture"),
    "blur": "window.dispatchEvent(new Event('blur'))",
    "visibilitychange": "Object.defineProperty(document, 'hidden', {get: () => true, configurable: true});"
                        "document.dispatchEvent(new Event('visibilitychange')); delete document.hidden",
    "pagehide": "window.dispatchEvent(new PageTransitionEvent('pagehide'))",
}


def test_the_page_sends_zero_at_each_event_that_may_be_the_last(page, world):
    page.run("document.getElementById('pad').addEventListener('pointerdown', ({pointerId}) =>"
             "{ window.pointer = pointerId; })")
    for event, dispatch in EVENTS.items():
        world.drive(page, ROBOT)
        with world.stops(ROBOT, what=event):
            page.run(f"const pad = document.getElementById('pad'); {dispatch}")
        assert page.sent()[-1].is_zero, event


def test_a_finger_that_stayed_on_the_pad_must_lift_after_another_tab_was_in_front(page, world):
    world.drive(page, ROBOT)
    with world.stops(ROBOT, what="another tab is in front"):
        page.new_tab(f"{world.address}icon.svg")
    assert page.sent()[-1].is_zero
    start = time.time()
    page.old_tab()
    page.wait_for_text("status", "stopped: ")
    page.move(0.8, 0.1)
    world.stay_stopped(ROBOT)
    assert all(command.is_zero for command in page.sent() if command.time > start)
    page.lift()
    world.drive(page, ROBOT)


KEYS = {"ArrowUp": forward, "w": forward, "ArrowDown": backward, "s": backward,
        "ArrowLeft": turn_left, "a": turn_left, "ArrowRight": turn_right, "d": turn_right}


def test_a_key_drives_until_it_is_let_go_also_if_the_page_never_sees_that(page, world):
    for key, wanted in KEYS.items():
        hold(key, page, world, wanted)
        page.let_go(key)
        world.wait_for_stop(ROBOT)
    hold("ArrowUp", page, world)
    page.new_tab()
    page.let_go("ArrowUp")
    world.wait_for_stop(ROBOT)
    page.old_tab()
    world.stay_stopped(ROBOT)
    hold("ArrowUp", page, world)
    page.let_go("ArrowUp")
    world.wait_for_stop(ROBOT)


def hold(key, page, world, wanted=forward):
    world.hold(page, lambda: page.press(key), lambda: page.let_go(key), ROBOT, wanted)


def test_a_gamepads_stick_drives_until_its_end_and_what_was_held_during_a_break_must_return_first(page, world):
    for end in lambda: page.gamepad(0, 0), page.unplug_gamepad:
        world.hold(page, lambda: page.gamepad(0, -1), lambda: page.gamepad(0, 0), ROBOT, forward)
        with world.stops(ROBOT, what="the stick's release or the gamepad's end"):
            end()

    def dies():
        page.gamepad(0, 0)
        world.hold(page, lambda: page.gamepad(0, -1), lambda: page.gamepad(0, 0), ROBOT, forward)
        world.wait_for(lambda: world.wheels(ROBOT) == STOPPED, 2.0, "the robot to stop, whatever its timestamp")
        page.wait_for(lambda: page.text("notice") == "Move the stick a little to go on", "the notice", 2.0)
    world.undisturbed(page, dies)
    world.stay_stopped(ROBOT)
    world.hold(page, lambda: page.gamepad(0, -0.98), lambda: page.gamepad(0, 0), ROBOT, forward)
    page.wait_for(lambda: not page.text("notice"), "the notice to go")
    page.gamepad(0, 0)
    world.hold(page, lambda: page.gamepad(0, -1), lambda: page.gamepad(0, 0), ROBOT, forward)
    with world.stops(ROBOT, what="the page's loss of the focus"):
        page.run("window.dispatchEvent(new Event('blur'))")
    world.stay_stopped(ROBOT, for_seconds=1.6)  # it counts as held still now
    page.gamepad(0, -0.98)
    world.stay_stopped(ROBOT)


TREMBLING = """const [dead] = navigator.getGamepads();
    const live = {...dead, index: 1, get axes() { return [Math.random() / 100, -1, 0, 0]; }};
    navigator.getGamepads = () => [dead, live, null, null]"""


def test_a_stick_that_trembles_in_the_hand_drives_on_beside_a_dead_gamepad(page, world):
    page.gamepad(0, -1)
    page.wait_for_text("notice", "Move the stick")
    world.hold(page, lambda: page.run(TREMBLING), lambda: page.gamepad(0, 0), ROBOT, forward)
    start = time.time()
    world.wait_for(lambda: page.sent()[-1].time > start + 2.0 or world.paused(page, start), 20.0, "2 s of commands")


def test_the_slider_sets_how_fast_full_deflection_is_and_neither_it_nor_keys_in_a_text_drive(page, world):
    x, y = page.place_of("#speed")
    page.touch_event("touchStart", (x, y))
    page.touch_event("touchMove", (x + 20, y))
    page.touch_event("touchMove", (x - 70, y))
    world.stay_stopped(ROBOT)
    page.lift()
    assert page.value("speed") != "50", "the finger moves the slider"
    page.set("speed", "20")
    world.drive(page, ROBOT, wanted=lambda left, right: 0.1 < left < 0.3)
    page.set("speed", "100")
    world.hold(page, lambda: None, lambda: page.touch(1, 0), ROBOT, lambda left, right: left > 0.9)
    page.lift()
    page.click("#speed")
    before = page.value("speed")
    hold("w", page, world)
    page.let_go("w")
    world.wait_for_stop(ROBOT)
    page.tap("ArrowDown")
    assert page.value("speed") != before, "arrow keys move the slider"
    name, start = page.element("name"), time.time()
    name.clear()
    name.send_keys("wasd d")
    world.stay_stopped(ROBOT)
    assert page.value("name") == "wasd d"
    assert not any(command.time > start for command in page.sent())
