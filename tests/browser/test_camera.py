"""A page shows what a robot's camera sees, while somebody looks, and keeps pictures; driving and stopping go first."""

import pytest

from .conftest import OTHER_ROBOT, ROBOT
from .screens import DESKTOP, TOUCH_SCREENS

BLIND = "jetbot_09"  # without a camera
PICTURE = """const camera = document.getElementById('camera');
    return camera.checkVisibility() ? camera.toDataURL() : ''"""
MARGINS = """for (const [id, text] of Object.entries({'save-free': 'Free 1000', 'save-blocked': 'Blocked 1000'}))
        document.getElementById(id).textContent = text;
    const box = (id) => document.getElementById(id).getBoundingClientRect(), view = box('view');
    return [box('camera').left - view.left, ...['save-free', 'save-blocked', 'delete'].flatMap(
        (id) => [box(id).left - box('camera').right, view.right - box(id).right, view.bottom - box(id).bottom])]"""
KEEP_STAMPS = """const receive = socket.onmessage, decode = createImageBitmap;
    window.stamps = [];
    window.drawn = new Promise(go => window.draw = go);
    window.createImageBitmap = async (jpeg) => { if (stamps.length) await drawn; return decode(jpeg); };
    socket.onmessage = (event) => {
        const message = typeof event.data === 'string' ? JSON.parse(event.data) : {};
        if (message.type === 'picture') stamps.push(message.stamp);
        receive(event);
    };"""
WAITED = "return Date.now() / 1000 - stamps[0]"


@pytest.fixture
def looking(page, world):
    """The page shows ROBOT's camera."""
    page.click("#show-camera")
    page.wait_for(lambda: page.run(PICTURE), "a picture")
    return page


def test_the_picture_follows_fits_each_screen_and_stop_stops_while_pictures_come(looking, world):
    before = looking.run(PICTURE)
    world.drive(looking, ROBOT, 0.0, 1.0)
    looking.wait_for(lambda: looking.run(PICTURE) not in ("", before), "another picture")
    with world.stops(ROBOT, what="a click on STOP beside the pictures"):
        looking.click("#stop")
    for screen in [*TOUCH_SCREENS, DESKTOP]:
        looking.resize(*screen, touch=screen != DESKTOP)
        looking.wait_for(lambda: looking.fits("camera", "status"), f"the picture on {screen}")
        assert min(looking.run(MARGINS)) >= 5, (screen, looking.run(MARGINS))


def wait_for_picture(page, world):
    page.wait_for(lambda: page.run(PICTURE) and world.is_seen(ROBOT), "a picture")


def test_a_camera_is_used_only_while_a_page_shows_it_and_pupils_see_it_while_their_teacher_lets_them(
        looking, pupil, world):
    looking.new_tab()
    world.wait_for(lambda: not world.is_seen(ROBOT), 10.0, "the camera to rest while the page is hidden")
    looking.old_tab()
    wait_for_picture(looking, world)
    looking.click("#show-codes")
    world.wait_for(lambda: not world.is_seen(ROBOT), 10.0, "the camera to rest behind the codes")
    pupil.click("#show-camera")
    wait_for_picture(pupil, world)
    looking.click("#cameras-switch")
    pupil.wait_for_text("no-picture", "Your teacher has switched the cameras off.")
    pupil.wait_for(lambda: pupil.run("return collect.hidden"), "the buttons to go")
    assert not pupil.run(PICTURE)
    looking.click("#close-codes")
    wait_for_picture(looking, world)
    looking.click("#show-codes")
    looking.click("#cameras-switch")
    wait_for_picture(pupil, world)
    pupil.click("#show-camera")
    looking.click("#close-codes")
    looking.click("#show-camera")
    world.wait_for(lambda: not world.is_seen(ROBOT), 10.0, "the camera to rest once it is closed")


def test_a_slow_page_gets_the_newest_picture_next(looking):
    looking.run(KEEP_STAMPS)
    looking.wait_for(lambda: (looking.run(WAITED) or 0) > 1, "a picture to be late")
    assert looking.run("return stamps.length") == 1
    looking.run("draw()")
    looking.wait_for(lambda: looking.run("return stamps.length") > 1, "the next picture")
    first, second = looking.run("return stamps.slice(0, 2)")
    assert second - first > 0.5


def press(page, button):
    """Press a button while a finger is on the pad."""
    page.run("document.getElementById(arguments[0]).click()", button)


def test_pictures_are_kept_and_deleted_by_who_drives(looking, pupil, world):
    pupil.click("#show-camera")
    wait_for_picture(pupil, world)
    world.drive(looking, ROBOT, 0.0, 1.0)  # with a finger that stays: a driver who rests is none after 5 s
    for label in "free", "blocked":
        press(looking, f"save-{label}")
        looking.wait_for_text(f"save-{label}", "1")
        assert world.pictures(ROBOT, label)[0].read_bytes().startswith(b"\xff\xd8")
    looking.lift()
    pupil.click("#save-free")
    pupil.wait_for_text("notice", f"Only who drives {ROBOT} collects its pictures.")
    looking.run("window.setTimeout = () => 0")  # nothing goes by itself
    looking.click("#delete")
    looking.wait_for_text("delete", "Delete all?")
    looking.choose(OTHER_ROBOT)
    looking.wait_for(lambda: looking.text("delete") == "Delete", "the question to go with the robot")
    looking.choose(ROBOT)
    world.drive(looking, ROBOT, 0.0, 1.0)
    press(looking, "delete")
    looking.wait_for_text("delete", "Delete all?")
    assert len(world.pictures(ROBOT, "free")) == 1
    press(looking, "delete")
    looking.wait_for_text("save-free", "0")
    assert not world.pictures(ROBOT, "free")


def test_without_a_camera_the_page_says_so_and_shows_no_old_picture(looking, world):
    robot = world.publish_status(BLIND, "blind")
    looking.choose(BLIND)
    looking.wait_for_text("no-picture", "Is the robot's camera on? (camera:=true) Pictures above 1 MB are not shown.")
    assert not looking.run(PICTURE)
    looking.choose(ROBOT)
    looking.wait_for(lambda: looking.run(PICTURE), "a picture")
    world.kill(robot)
    looking.wait_for(lambda: f"/{BLIND}" not in looking.robots(), f"{BLIND} to go")
