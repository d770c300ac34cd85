"""The page fits the screen, and works with a keyboard alone, with a finger, and with a screen reader."""

from jetbot.wait import wait_until

from .conftest import OTHER_ROBOT, ROBOT
from .messages import DONE, LONG
from .screens import DESKTOP, FINGER, MOUSE, TOUCH_SCREENS
from .test_driving import hold

SMALL_PHONE = (320, 568)  # px
COUNT_MOVING = """return [...document.querySelectorAll('*')].filter(each => {
    const style = getComputedStyle(each);
    return style.animationName !== 'none' || style.transitionDuration.split(', ').some(time => time !== '0s');
}).length"""


GAP_ABOVE_PAD = """const bottom = Math.max(...[...document.querySelectorAll('#bar :is(button, a)')]
    .map(each => each.getBoundingClientRect().bottom));
return document.getElementById('pad').getBoundingClientRect().top - bottom"""


def test_the_choice_of_the_language_is_in_the_bar_which_stays_one_row_on_a_pupils_phone(page, pupil):
    for screen in [SMALL_PHONE, *TOUCH_SCREENS, DESKTOP]:
        for each in page, pupil:
            each.resize(*screen)
            each.wait_for(lambda each=each: each.outside("#bar .language", "#bar") == [], f"the choice on {screen}")
        assert pupil.element("bar").size["height"] < 50 or screen == SMALL_PHONE, screen


def test_a_teacher_sees_a_class_on_one_screen_each_status_to_its_end_and_all_robots_on_the_map(page):
    page.resize(*DESKTOP, touch=False)
    page.receive_class(status="stopped: no command for 1.0 s", fake=True)
    page.wait_for_text("fleet", "15 robots")
    assert page.outside("#fleet li", "#fleet-list") == []
    assert page.cut("#fleet .why") == []
    assert "fake" not in page.text("fleet")
    for screen in (1024, 768), DESKTOP:
        page.resize(*screen)
        page.receive_class()
        page.click("#fit")
        page.wait_for(lambda: page.under_tools() == [], f"all robots on the map of {screen}")


def test_a_teacher_reads_who_drives_to_its_end_and_no_button_touches_the_pad(page):
    page.receive_class(2, driver={"id": 99, "name": "Maximilian-Alexander"})
    for screen in (1024, 768), DESKTOP:
        page.resize(*screen)
        page.wait_for_text("fleet", "Maximilian-Alexander drives it")
        assert page.cut("#fleet .who") == [], screen
    page.resize(640, 360)
    page.wait_for(lambda: page.element("take").is_displayed(), "Take over")
    assert page.run(GAP_ABOVE_PAD) >= 4


def test_go_on_is_offered_only_where_something_waits(page):
    page.resize(*DESKTOP)
    for held, waiting, offered in (("robot", [], True), ("programs", [], False), ("programs", ["/circle"], True)):
        page.receive_class(2, state="stopped", held=held, waiting=waiting)
        page.wait_for(lambda offered=offered: [page.element(each).is_displayed() for each in ("go-on", "all-go-on")]
                      == [offered, offered], f"Go on while {waiting} wait for {held}: {offered}")


def test_on_an_upright_tablet_the_map_keeps_a_third_and_on_small_screens_the_legend_its_words(page):
    for width, height in (768, 960), (360, 640), (640, 360), (320, 568):
        page.resize(width, height)
        page.receive_class(status=LONG, state="stopped", task=DONE if height > 600 else None)
        page.wait_for(lambda: page.cut("#legend :is(dt, dd)") == [], f"the legend on {width} x {height}")
        if width == 768:
            page.receive({"type": "notice", "text": LONG})
            page.wait_for_text("status", LONG.strip())
            assert page.element("view").size["height"] > height / 3


def test_bars_and_trails_stand_out_by_day_and_by_night(page):
    zigzag = [[x / 2, 20 * (-1) ** x] for x in range(-40, 41)]  # wherever the map's middle is
    try:
        for scheme in "dark", "light":
            page.media(prefers_color_scheme=scheme)
            for color in "#000080", "#ffff00":
                page.receive_class(1, color, pose=None)
                page.receive({"type": "trail", "robot": "/jetbot_01", "points": zigzag})
                page.choose("jetbot_01")
                page.wait_for(lambda: min(page.contrast_of_robot()) >= 3, f"{color} to stand out, {scheme}")
                shown = page.run("return document.documentElement.style.getPropertyValue('--robot')")
                page.wait_for(lambda shown=shown: page.shows_on_map(shown), f"the trail in {shown}, {scheme}")
    finally:
        page.media()


def check_screen(page, screen, *parts):
    page.resize(*screen, touch=screen != DESKTOP)
    wait_until(lambda: page.fits(*parts), 20.0)
    assert page.misplaced(*parts) == [] and page.fits(*parts), f"not all is on the screen of {screen}"
    assert page.small_controls(MOUSE if screen == DESKTOP else FINGER) == [], screen


def test_each_control_has_a_name_and_is_reached_by_tab_and_the_keyboard_alone_drives_and_stops(page, world):
    controls = page.controls()
    for name in {*controls, "pad", "map", "wheels"}:
        assert page.element(name).accessible_name, f"#{name} has no label"
    assert page.element("status").aria_role == "status"
    assert page.element("link").get_attribute("aria-live") == "off", "the round trip is not read out each second"
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


def test_nothing_moves_for_those_who_prefer_that(page):
    page.media(prefers_reduced_motion="reduce")
    try:
        assert page.run(COUNT_MOVING) == 0
    finally:
        page.media()
