"""A teacher's page with a class that only it knows: what fits and stands out, what has the focus, and what is said."""

import pytest

from .conftest import OTHER_ROBOT, ROBOT, opened
from .messages import BEN, BEST, DONE, LONG, TASK, codes_of, robot_named
from .screens import DESKTOP, TOUCH_SCREENS

GAP_ABOVE_PAD = """const bottom = Math.max(...[...document.querySelectorAll('#bar :is(button, a)')]
    .map(each => each.getBoundingClientRect().bottom));
return document.getElementById('pad').getBoundingClientRect().top - bottom"""
FOCUSED = """const {activeElement: each} = document;
return each.id || [each.className, each.closest("[data-robot]")?.dataset.robot].join(" ")"""
LISTEN = """window.said = [];
const regions = "[aria-live], [role=status], [role=alert]";
new MutationObserver((changes) => {
    for (const {target} of changes) {
        const region = (target.closest ? target : target.parentElement).closest(regions);
        if (region && region.ariaLive !== "off" && target.textContent) said.push(target.textContent);
    }
}).observe(document.body, {subtree: true, childList: true, characterData: true});"""


NO_SCORES = {**BEST, "scores": []}  # those of earlier tests have a button in the bar


@pytest.fixture(scope="module")
def opened_page(browsers, world):
    for page in opened(browsers(1), world, world.address):
        page.receive(NO_SCORES)
        yield page


@pytest.fixture
def page(opened_page):
    """The page on a desktop; it gets nothing of the cockpit once it has received a class."""
    opened_page.resize(*DESKTOP, touch=False)
    return opened_page


def test_a_pupils_bar_stays_one_row(pupil):
    pupil.receive_class(2)
    pupil.receive(NO_SCORES)
    for screen in [*TOUCH_SCREENS, DESKTOP]:
        pupil.resize(*screen)
        pupil.wait_for(lambda: pupil.element("bar").size["height"] < 50, f"one row on {screen}")


def test_a_teacher_sees_a_class_on_one_screen_each_status_to_its_end_and_all_robots_on_the_map(page):
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
    for screen in DESKTOP, (1024, 768):
        page.resize(*screen)
        page.wait_for_text("fleet", "Maximilian-Alexander drives it")
        assert page.cut("#fleet .who") == [], screen
    page.resize(640, 360)
    page.wait_for(lambda: page.element("take").is_displayed(), "Take over")
    assert page.run(GAP_ABOVE_PAD) >= 4


def test_go_on_is_offered_only_where_something_waits(page):
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
    for scheme in "dark", "light":
        page.media(prefers_color_scheme=scheme)
        for color in "#000080", "#ffff00":
            page.receive_class(1, color, pose=None)
            page.receive({"type": "trail", "robot": "/jetbot_01", "points": zigzag})
            page.choose("jetbot_01")
            page.wait_for(lambda: min(page.contrast_of_robot()) >= 3, f"{color} to stand out, {scheme}")
            shown = page.run("return document.documentElement.style.getPropertyValue('--robot')")
            page.wait_for(lambda shown=shown: page.shows_on_map(shown), f"the trail in {shown}, {scheme}")


def focus_on(page, selector):
    page.run("document.querySelector(arguments[0]).focus()", selector)
    assert page.run("return document.activeElement.matches(arguments[0])", selector), selector


def wait_for_focus(page, wanted):
    page.wait_for(lambda: page.run(FOCUSED) == wanted, f"the focus on {wanted}")


def of_class(robots=2, **state):
    return lambda page: page.receive_class(robots, **state)


def shows_codes(page):
    page.click("#show-codes")
    page.receive(codes_of(3))


def a_robot_comes(page):
    page.receive({"type": "robots", "robots": [robot_named(name) for name in ("ada", ROBOT, OTHER_ROBOT)]})
    page.wait_for_text("fleet-list", "ada")


LOSSES = [  # what comes first, what has the focus, what takes that from it, and what has it then
    (of_class(driver=BEN), "#take", of_class(held="robot"), "pad"),
    (of_class(held="robot"), "#go-on", of_class(), "pad"),
    (shows_codes, "#close-codes", lambda page: page.tap("Enter"), "show-codes"),
    (of_class(3), "#name", lambda page: page.tap("Enter"), "pad"),
    (shows_codes, "#codes-list li:last-child input", lambda page: page.tap("Enter"), "print-codes"),
    (lambda page: page.click("#close-codes"), "#robot", of_class(1), "show-codes"),
    (lambda page: page.receive(BEST), "#show-scores", lambda page: page.receive(NO_SCORES), "to-program"),
    (of_class(2), f"[data-robot='/{OTHER_ROBOT}'] .stop-one", a_robot_comes, f"stop-one /{OTHER_ROBOT}"),
    (of_class(3), "[data-robot='/jetbot_03'] .stop-one", of_class(2), "robot"),
    (of_class(1, pictures={"free": 1, "blocked": 0, "problem": None}), "#save-free", of_class(1), "zoom-in"),
]


def test_the_focus_is_never_lost(page):
    page.click("#show-camera")
    for before, control, act, then in LOSSES:
        before(page)
        page.wait_for(lambda control=control: page.driver.find_element("css selector", control).is_displayed(), control)
        focus_on(page, control)
        act(page)
        wait_for_focus(page, then)
    page.click("#show-camera")


def test_what_changes_all_the_time_is_not_said_and_what_counts_is_said_once(page):
    page.receive_class(2)
    page.wait_for_text("status", "waiting for its status")
    page.run(LISTEN)
    for number in range(20):
        task = {**TASK, "state": "driving", "seconds": number / 10}
        page.receive_class(2, pose=[number / 10, 0, 0], speed=[number / 10, 0], command=[number / 20, 0], task=task,
                           wheels=[number / 20] * 2, status="driving", driver={**BEN, "name": f"Ben {number}"})
        page.wait_for_text("driver", f"Ben {number} drives")
    assert page.run("return said") == ["driving"]
    page.receive_class(2, status="stopped: its motors", cause="board", state="stopped", stopped=True)
    page.receive({"type": "notice", "code": "", "text": "Ask Ben.", "template": "Ask {driver}.",
                  "arguments": {"driver": "Ben"}})
    page.wait_for_text("status", "its motors")
    page.wait_for_text("notice", "Ask Ben.")
    assert sorted(page.run("return said")) == ["Ask Ben.", "driving", "stopped: its motors"]
