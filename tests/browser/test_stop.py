"""Everybody who watches can stop every robot, also with one hand while the other one drives or types."""


from .conftest import OTHER_ROBOT, ROBOT
from .world import moving

HELD = 0.9, 0.0  # where the first finger is on the pad
CONFIRM_TIMEOUT = 1.2  # s; the page waits 1 s
KEEP_KINDS = """const send = WebSocket.prototype.send; window.kinds = [];
    WebSocket.prototype.send = function (text) { kinds.push(JSON.parse(text).type); send.call(this, text); }"""

RELEASE_IS_DISABLED = "return document.querySelector('#release').disabled"


def stop(page):
    page.click("#stop")
    wait_for_stop(page)


def wait_for_stop(page):
    page.wait_for(lambda: page.has(".emergency") and page.say("emergency stop") in page.text("status"), "the stop")


def release(page):
    """Release what is stopped, if anything is, and wait until the page knows that."""
    page.click("#release")
    wait_for_release(page)


def wait_for_release(page):
    page.wait_for(lambda: not page.has(".emergency, #release.needed"), "the release")


def touch_with_second_finger(page, selector):
    """Touch an element while the first finger stays on the pad."""
    page.touch_event("touchStart", page.on_pad(*HELD), page.place_of(selector))


def lift_second_finger(page, selector):
    """The browser makes no click of this."""
    x, y = page.place_of(selector)
    page.driver.execute_cdp_cmd("Input.dispatchTouchEvent",
                                {"type": "touchEnd", "touchPoints": [{"x": x, "y": y, "id": 1}]})


def test_a_pupils_button_stops_all_robots_and_none_starts_by_itself_after_the_teachers_release(page, pupil, world):
    pupil.choose(OTHER_ROBOT)
    world.drive(page, ROBOT)
    world.drive(pupil, OTHER_ROBOT)
    with world.stops(ROBOT, OTHER_ROBOT, what="a pupil's click on STOP"):
        pupil.click("#stop")
    for each in page, pupil:
        wait_for_stop(each)
    release(page)
    world.stay_stopped(ROBOT, OTHER_ROBOT)
    page.lift()
    world.drive(page, ROBOT)
    page.lift()
    page.click("#stop")
    pupil.wait_for_text("status", "Your teacher stopped all robots.")
    assert pupil.run(RELEASE_IS_DISABLED)
    release(page)
    pupil.wait_for(lambda: not pupil.run(RELEASE_IS_DISABLED), "a Release that can be pressed")


def test_a_key_or_ros_stops_and_what_is_still_held_does_not_drive_after_the_release(page, world):
    for key, act in (("Escape", lambda: page.tap("Escape")), ("Space", lambda: page.tap("Space")),
                     ("emergency_stop.py", world.emergency_stop)):
        world.hold(page, lambda: page.press("ArrowUp"), lambda: page.let_go("ArrowUp"), ROBOT)
        act()
        world.wait_for_stop(ROBOT, key)
        wait_for_stop(page)
        release(page)
        world.stay_stopped(ROBOT)
        page.let_go("ArrowUp")
    page.click("#name")
    page.tap("Escape")
    wait_for_stop(page)
    page.touch()
    page.wait_for_text("notice", "it must be released first")
    world.stay_stopped(ROBOT)
    page.lift()
    release(page)
    page.wait_for(lambda: not page.text("notice"), "the notice to go", within=3.0)
    world.drive(page, ROBOT)


def test_a_second_finger_stops_and_releases_all_or_one_robot_of_the_list_once_while_another_drives(page, world):
    world.drive(page, ROBOT, *HELD)
    touch_with_second_finger(page, "#stop")
    world.wait_for_stop(ROBOT)
    wait_for_stop(page)
    lift_second_finger(page, "#stop")
    touch_with_second_finger(page, "#release")
    lift_second_finger(page, "#release")
    wait_for_release(page)
    world.stay_stopped(ROBOT)
    page.lift()
    page.resize(1280, 800)
    button = f"#fleet li[data-robot='/{OTHER_ROBOT}'] .stop-one"

    def stop_while_driving():
        world.drive(page, ROBOT, *HELD)
        if page.text_of(button) == "Stop":
            touch_with_second_finger(page, button)
            lift_second_finger(page, button)
        page.wait_for(lambda: page.text_of(button) == "Release", "the stop")
        world.stay(moving, ROBOT)
    world.undisturbed(page, stop_while_driving)
    page.lift()
    page.choose(OTHER_ROBOT)
    page.wait_for_text("status", "its own emergency stop")
    page.click(button)  # pointer events and a click: one release
    page.wait_for(lambda: page.text_of(button) == "Stop", "the release")
    world.drive(page, OTHER_ROBOT)


def test_each_press_is_sent_once_and_confirmed_also_after_a_lost_connection_and_else_is_reported(page, world):
    page.run(KEEP_KINDS)
    for press in (lambda: page.element("stop").send_keys("\n"), lambda: page.click("#stop"),
                  lambda: page.run("document.getElementById('stop').click()")):
        press()
        wait_for_stop(page)
        release(page)
    assert [kind for kind in page.run("return kinds") if kind in ("stop", "release")] == ["stop", "release"] * 3
    world.stay_stopped(ROBOT, for_seconds=CONFIRM_TIMEOUT)
    assert not page.text("notice")
    page.run("socket.close()")
    page.wait_for_text("status", "No connection")
    page.click("#stop")
    page.wait_for_text("notice", "reached no robot")
    wait_for_stop(page)
    release(page)
    page.run("WebSocket.prototype.send = () => {}")
    page.click("#stop")
    page.wait_for_text("unconfirmed", "not confirmed")
