"""A person stops and releases with one hand while the other one drives or types."""

import pytest

from .conftest import OTHER_ROBOT, ROBOT

HELD = 0.9, 0.0  # where the first finger is on the pad
CONFIRM_TIMEOUT = 1.5  # s


def centre_of(page, selector):
    """Return where an element is, as (x, y) in px."""
    box = page.run(f"return document.querySelector(`{selector}`).getBoundingClientRect().toJSON()")
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def touch_with_second_finger(page, selector):
    """Touch an element while the first finger stays on the pad."""
    page.touch_event("touchStart", page.on_pad(*HELD), centre_of(page, selector))


def lift_second_finger(page, selector):
    """The browser makes no click of this."""
    x, y = centre_of(page, selector)
    page.driver.execute_cdp_cmd("Input.dispatchTouchEvent",
                                {"type": "touchEnd", "touchPoints": [{"x": x, "y": y, "id": 1}]})


def tap_with_second_finger(page, selector):
    touch_with_second_finger(page, selector)
    lift_second_finger(page, selector)


def test_a_second_finger_stops_and_releases(page, world):
    world.drive(page, ROBOT, *HELD)
    touch_with_second_finger(page, "#stop")
    world.wait_for_stop(ROBOT, within=1.0)
    page.wait_for_text("status", "emergency stop")
    lift_second_finger(page, "#stop")
    tap_with_second_finger(page, "#release")
    page.wait_for_text("status", "emergency stop was released")
    world.stay_stopped(ROBOT)
    page.lift()


def test_a_second_finger_stops_one_robot_of_the_list_once(page, world):
    page.screen(1280, 800)
    stop = f"#fleet li[data-robot='/{OTHER_ROBOT}'] .stop-one"
    page.touch()
    tap_with_second_finger(page, stop)
    page.wait_for(lambda: page.run(f"return document.querySelector(`{stop}`).textContent") == "Release", "the stop")
    page.lift()
    page.click(stop)  # pointer events and a click: one release
    page.wait_for(lambda: page.run(f"return document.querySelector(`{stop}`).textContent") == "Stop", "the release")


@pytest.mark.parametrize("press", [
    lambda page: page.element("stop").send_keys("\n"), lambda page: page.run("document.getElementById('stop').click()"),
    lambda page: page.click("#stop")], ids=["Enter", "click", "mouse"])
def test_each_press_is_sent_once(press, page, world):
    page.run("const send = WebSocket.prototype.send; window.sent = [];"
             "WebSocket.prototype.send = function (text) { sent.push(JSON.parse(text).type); send.call(this, text); }")
    press(page)
    page.wait_for_text("status", "emergency stop")
    assert page.run("return sent.filter(type => type === 'stop').length") == 1
    page.click("#release")
    page.wait_for_text("status", "emergency stop was released")
    assert page.run("return sent.filter(type => type === 'release').length") == 1


def test_escape_stops_while_a_name_is_typed(page, world):
    page.element("name").click()
    page.press("Escape")
    page.let_go("Escape")
    page.wait_for_text("status", "emergency stop")


def test_w_drives_while_the_slider_has_the_focus_and_the_arrows_move_it(page, world):
    page.element("speed").click()
    before = page.element("speed").get_attribute("value")
    world.hold(page, lambda: page.press("w"), lambda: page.let_go("w"), ROBOT)
    page.let_go("w")
    world.wait_for_stop(ROBOT)
    page.press("ArrowUp")
    page.let_go("ArrowUp")
    assert page.element("speed").get_attribute("value") != before
    world.stay_stopped(ROBOT)


def test_a_stop_that_is_released_at_once_was_confirmed(page, world):
    page.element("stop").click()
    page.wait_for(lambda: page.run("return document.body.classList.contains('emergency')"), "the stop")
    page.element("release").click()
    page.wait_for_text("status", "emergency stop was released")
    world.stay_stopped(ROBOT, for_seconds=CONFIRM_TIMEOUT)
    assert not page.text("notice")


def test_a_refusal_goes_once_it_is_not_true_any_more(page, world):
    page.element("stop").click()
    page.wait_for_text("status", "emergency stop")
    page.touch()
    page.wait_for_text("notice", "Release it first")
    page.lift()
    page.element("release").click()
    page.wait_for(lambda: not page.text("notice"), "the notice to go", within=3.0)


def test_the_status_has_who_drives_and_the_round_trip(page, world):
    page.rename("Ada")
    world.drive(page, ROBOT)
    page.wait_for(lambda: "You drive it" in page.text("status") and " ms" in page.text("status"), "all of #status")
    assert page.element("link").get_attribute("aria-live") == "off", "it is not read out each second"


def test_who_loses_a_robot_is_told_who_took_it(page, pupil, world):
    page.rename("Ada")
    world.drive(pupil, ROBOT)
    page.wait_for(lambda: page.element("take").is_displayed(), "the button")
    page.element("take").click()
    pupil.wait_for_text("notice", f"Ada has taken {ROBOT}")
    pupil.lift()


def test_the_teachers_code_is_shown_only_when_asked_for(page, world):
    teachers = world.codes()["teacher"].partition("#")[2]
    page.element("show-codes").click()
    page.wait_for_text("codes", world.codes()["pupil"].partition("#")[2])
    assert teachers not in page.text("codes")
    page.element("show-teacher").click()
    page.wait_for_text("codes", teachers)


def test_a_stop_that_was_pressed_without_a_connection_is_sent_when_it_is_back(page, world):
    page.run("const Socket = window.WebSocket, send = Socket.prototype.send; let socket;"
             "Socket.prototype.send = function (text) { socket = this; send.call(this, text); };"
             "window.cut = () => socket.close()")
    page.wait_for(lambda: page.run("try { cut(); return true } catch { return false }"), "a message", within=3.0)
    page.wait_for_text("status", "No connection")
    page.element("stop").click()
    page.wait_for_text("status", "emergency stop")
