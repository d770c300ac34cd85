"""The page fits the screen, and works with a keyboard alone, with a finger, and with a screen reader."""

from .conftest import OTHER_ROBOT, ROBOT
from .test_driving import hold

TOUCH_SCREENS = [(360, 640), (390, 844), (844, 390), (820, 1180), (1180, 820)]  # px
DESKTOP = (1280, 800)
FINGER, MOUSE = 44, 24  # px that each control has at least
LONG = "stopped: " + "a reason that nobody has ever shortened, " * 7
NAME = "a_robot_with_a_name_of_forty_characters_"
LONG_TEXTS = f"""document.getElementById('sentence').textContent = {LONG!r};
    document.getElementById('notice').textContent = {LONG!r};
    document.getElementById('notice').hidden = false;
    document.getElementById('driver').textContent = '{"W" * 20} drives it';
    for (const each of document.querySelectorAll('#robot option, #fleet .label')) each.textContent = {NAME!r};"""
COUNT_MOVING = """return [...document.querySelectorAll('*')].filter(each => {
    const style = getComputedStyle(each);
    return style.animationName !== 'none' || style.transitionDuration.split(', ').some(time => time !== '0s');
}).length"""


def test_everything_fits_the_screen_and_the_finger(page, pupil):
    page.type("name", "W" * 20)
    for each in page, pupil:
        for screen in [*TOUCH_SCREENS, DESKTOP]:
            each.run("document.getElementById('notice').hidden = true")
            check_screen(each, screen, "pad", "stop", "status", "map")
            each.run(LONG_TEXTS)
            assert each.misplaced("pad", "stop", "release") == [], f"with long texts on {screen}"
            assert each.fits(), f"with long texts on {screen}"


def check_screen(page, screen, *parts):
    page.resize(*screen, touch=screen != DESKTOP)
    page.wait_for(lambda: page.fits(*parts), f"all on the screen of {screen}")
    assert page.small_controls(MOUSE if screen == DESKTOP else FINGER) == [], screen


def test_the_tab_key_reaches_every_control_and_the_keyboard_alone_drives_and_stops(page, world):
    controls = page.controls()
    assert {"pad", "stop", "release", "robot", "speed", "name"} <= set(controls)
    assert set(controls) <= {page.tab() for _ in range(len(controls) + 5)}
    page.tab_to("speed")
    page.tap("ArrowLeft")
    assert page.value("speed") == "45"
    world.stay_stopped(ROBOT)
    page.tab_to("robot")
    page.tap("ArrowDown")
    assert page.value("robot") == f"/{OTHER_ROBOT}"
    page.tap("ArrowUp")
    page.tab_to("pad")
    hold("ArrowUp", page, world)
    page.let_go("ArrowUp")
    page.tab_to("stop")
    page.tap("Enter")
    page.wait_for_text("status", "emergency stop")
    page.tab_to("release")
    page.tap("Enter")
    page.wait_for_text("status", "was released")


def test_each_control_has_a_name_for_a_screen_reader(page):
    for name in {*page.controls(), "pad", "map", "wheels"}:
        assert page.element(name).accessible_name, f"#{name} has no label"
    assert page.element("status").aria_role == "status"
    assert page.element("link").get_attribute("aria-live") == "off", "the round trip is not read out each second"


def test_nothing_moves_for_those_who_prefer_that(page):
    page.media(prefers_reduced_motion="reduce")
    try:
        assert page.run(COUNT_MOVING) == 0
    finally:
        page.media()
