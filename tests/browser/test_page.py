"""The page fits the screen, and works with a keyboard alone, with a finger, and with a screen reader."""

import time

from .conftest import OTHER_ROBOT, ROBOT
from .test_driving import forward, hold

TOUCH_SCREENS = [(360, 640), (390, 844), (844, 390), (820, 1180), (1180, 820)]  # px
DESKTOP = (1280, 800)
FINGER, MOUSE = 44, 24  # px that each control has at least
LONG = "stopped: " + "a reason that nobody has ever shortened, " * 7
NAME = "a_robot_with_a_name_of_forty_characters__"[:40]
HIDDEN = 5.0  # s; the cockpit no longer sends to pages without a sign of life for 3 s
LEVELS = "driving", "waiting", "warning", "stopped"


def test_everything_fits_the_screen_and_the_finger(page, pupil):
    page.rename("W" * 20)
    for each in page, pupil:
        for screen in [*TOUCH_SCREENS, DESKTOP]:
            check_screen(each, screen)


def check_screen(page, screen):
    page.resize(*screen, touch=screen != DESKTOP)
    page.run("document.getElementById('notice').hidden = true")
    page.wait_for(lambda: page.fits("pad", "stop", "status", "map"), f"all on the screen of {screen}")
    assert page.small_controls(MOUSE if screen == DESKTOP else FINGER) == [], screen
    page.run(f"""document.getElementById('sentence').textContent = {LONG!r};
        document.getElementById('notice').textContent = {LONG!r};
        document.getElementById('notice').hidden = false;
        document.getElementById('driver').textContent = 'WWWWWWWWWWWWWWWWWWWW drives it';
        for (const each of document.querySelectorAll('#robot option, #fleet .label')) each.textContent = {NAME!r};""")
    assert page.misplaced("pad", "stop", "release") == [], f"with long texts on {screen}"
    assert page.fits(), f"with long texts on {screen}"


def test_the_tab_key_reaches_every_control_and_the_keyboard_alone_drives_and_stops(page, world):
    reached = page.tab_through()
    controls = page.controls()
    assert {"pad", "stop", "release", "robot", "speed", "name"} <= set(controls)
    assert not [name for name in controls if name not in reached]
    page.tab_to("speed")
    page.press("ArrowLeft")
    page.let_go("ArrowLeft")
    assert page.run("return document.getElementById('speed').value") == "45"
    world.stay_stopped(ROBOT)
    page.tab_to("robot")
    page.press("ArrowDown")
    page.let_go("ArrowDown")
    assert page.run("return document.getElementById('robot').value") == f"/{OTHER_ROBOT}"
    page.press("ArrowUp")
    page.let_go("ArrowUp")
    page.tab_to("pad")
    hold("ArrowUp", page, world, forward)
    page.let_go("ArrowUp")
    page.tab_to("stop")
    page.press("Enter")
    page.let_go("Enter")
    page.wait_for_text("status", "emergency stop")
    page.tab_to("release")
    page.press("Enter")
    page.let_go("Enter")
    page.wait_for_text("status", "was released")


def test_each_control_has_a_name_for_a_screen_reader(page):
    assert all(page.element(name).accessible_name for name in page.controls())
    for name in "pad", "map", "wheels":
        assert page.element(name).accessible_name, f"#{name} has no label"
    assert page.element("status").aria_role == "status"


def test_texts_can_be_read_and_nothing_moves_for_those_who_prefer_that(page):
    try:
        check_looks(page, "light")
        check_looks(page, "dark")
    finally:
        page.media()


def check_looks(page, scheme):
    page.media(prefers_color_scheme=scheme, prefers_reduced_motion="reduce")
    page.resize(*DESKTOP)
    for level in LEVELS:
        page.run(f"document.getElementById('status').dataset.level = '{level}';"
                 f"for (const row of document.querySelectorAll('#fleet li')) row.dataset.level = '{level}';"
                 "document.getElementById('notice').textContent = 'a notice';"
                 "document.getElementById('notice').hidden = false;")
        assert page.pale_texts() == [], f"contrast below WCAG's AA while {level} in {scheme}"
    assert page.run("return matchMedia('(prefers-reduced-motion: reduce)').matches")
    assert page.run("""return [...document.querySelectorAll('*')].filter(each => {
        const style = getComputedStyle(each);
        return style.animationName !== 'none' || style.transitionDuration.split(', ').some(time => time !== '0s');
    }).length""") == 0, "nothing moves for those who prefer that"
    page.run("document.getElementById('login').hidden = false")
    assert page.pale_texts() == []
    page.run("document.getElementById('login').hidden = true")


def test_a_page_that_was_hidden_for_a_while_is_up_to_date_at_once(page, world):
    page.new_tab()
    time.sleep(HIDDEN)
    page.old_tab()
    page.wait_for(lambda: page.text("status").startswith("stopped: ") and "ms" in page.text("link"), "the state", 1.0)
    world.drive(page, ROBOT)


def test_nothing_comes_from_another_host(page, world):
    urls = page.run("return performance.getEntriesByType('resource').map(entry => entry.name)")
    assert urls and all(url.startswith(world.address) for url in urls)
