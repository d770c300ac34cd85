"""Everybody can use the pad's page: by keys alone, and with a screen reader."""

from .accessibility import tree, violations
from .conftest import OTHER_ROBOT, ROBOT
from .messages import BEN, BEST, TASK, codes_of, robot_named
from .screens import DESKTOP
from .test_access import split
from .test_stop import release

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


def shows_codes(page):
    page.click("#show-codes")
    page.receive(codes_of(3))


def press(*buttons):
    """Return what presses these buttons, one after the other."""
    return lambda page: [page.click(button) for button in buttons]


EDGES = """const { borderTopWidth, outlineWidth } = getComputedStyle(document.querySelector(arguments[0]));
return [borderTopWidth, outlineWidth]"""


def test_in_english_too_what_a_button_shows_is_in_its_name(page):
    page.resize(*DESKTOP, touch=False)
    assert violations(page) == []


def test_high_contrast_shows_stop_what_is_chosen_and_the_focus(page, world):
    page.media(forced_colors="active")
    try:
        for path, chosen in ("program", "show-map"), ("", "show-codes"):
            page.open(f"{world.address}{path}")
            page.resize(*DESKTOP, touch=False)
            page.click(f"#{chosen}")
            assert page.run(EDGES, f"#{chosen}")[0] == "3px"
            page.tab_to("stop")
            assert page.run(EDGES, "#stop") == ["4px", "3px"]
    finally:
        page.media()


def test_the_focus_goes_down_the_page(page):
    controls = "robot", "zoom-in", "speed", "stop", "release"
    for screen in (390, 844), (820, 1180), DESKTOP:
        page.resize(*screen)
        heights = [round(page.place_of(f"#{name}")[1]) for name in controls]
        assert heights == sorted(heights), screen
    assert [name for name in page.controls() if name in controls] == list(controls)


def focus_on(page, selector):
    page.run("document.querySelector(arguments[0]).focus()", selector)
    assert page.run("return document.activeElement.matches(arguments[0])", selector), selector


def wait_for_focus(page, wanted):
    page.wait_for(lambda: page.run(FOCUSED) == wanted, f"the focus on {wanted}")


def holds_arrow(page, world):
    world.hold(page, lambda: page.press("ArrowUp"), lambda: page.let_go("ArrowUp"), ROBOT)
    page.wait_for_text("pad-news", "You steer ahead.")
    page.let_go("ArrowUp")
    page.wait_for(lambda: not page.text("pad-news"), "the end of that")


def test_keys_alone_lead_from_the_login_to_driving_taking_over_stop_and_release(page, pupil, world):
    address, code = split(world.codes()["pupil"])
    pupil.driver.delete_all_cookies()
    pupil.driver.get(address)
    wait_for_focus(pupil, "code")
    for key in [*code, "Enter"]:
        pupil.tap(key)
    wait_for_focus(pupil, "pad")
    pupil.wait_for_text("driver", "Free to drive")
    holds_arrow(pupil, world)
    page.tab_to("take")
    page.tap("Enter")
    wait_for_focus(page, "pad")
    holds_arrow(page, world)
    for button, status in ("stop", "emergency stop"), ("release", "was released"):
        page.tab_to(button)
        page.tap("Enter")
        page.wait_for_text("status", status)
        assert page.run(FOCUSED) == button


def test_a_screen_reader_finds_the_pad_and_learns_where_the_robot_is(page, world):
    page.wait_for(lambda: "faces ahead" in page.element("map").get_attribute("aria-label"), "the robot's place")
    place = page.element("map").get_attribute("aria-label")
    found = tree(page)
    pad = next(each for each in found if each.role == "application")
    assert pad.name.startswith("Joystick") and "arrow keys" in pad.description and place in pad.description
    assert any(each.role == "image" and each.name == place for each in found)
    assert any((each.role, each.name, each.value) == ("slider", "Speed", "50") for each in found)
    order = [each.name for each in found if each.role in ("region", "button")]
    assert order.index("Robot and people") < order.index("Map") < order.index("Drive") < order.index("STOP all robots")


def of_class(robots=2, **state):
    return lambda page: page.receive_class(robots, **state)


def a_robot_comes(page):
    page.receive({"type": "robots", "robots": [robot_named(name) for name in ("ada", ROBOT, OTHER_ROBOT)]})
    page.wait_for_text("fleet-list", "ada")


LOSSES = [  # what comes first, what has the focus, what takes that from it, and what has it then
    (of_class(driver=BEN), "#take", of_class(held="robot"), "pad"),
    (of_class(held="robot"), "#go-on", of_class(), "pad"),
    (shows_codes, "#close-codes", lambda page: page.tap("Enter"), "show-codes"),
    (of_class(3), "#name", lambda page: page.tap("Enter"), "pad"),
    (shows_codes, "#codes-list li:last-child input", lambda page: page.tap("Enter"), "print-codes"),
    (press("#close-codes"), "#robot", of_class(1), "show-codes"),
    (lambda page: page.receive(BEST), "#show-scores", lambda page: page.receive({**BEST, "scores": []}), "to-program"),
    (of_class(2), f"[data-robot='/{OTHER_ROBOT}'] .stop-one", a_robot_comes, f"stop-one /{OTHER_ROBOT}"),
    (of_class(3), "[data-robot='/jetbot_03'] .stop-one", of_class(2), "robot"),
    (of_class(1, pictures={"free": 1, "blocked": 0, "problem": None}), "#save-free", of_class(1), "zoom-in"),
]


def test_the_focus_is_never_lost(page):
    page.resize(*DESKTOP, touch=False)
    page.click("#show-camera")
    for before, control, act, then in LOSSES:
        before(page)
        page.wait_for(lambda control=control: page.driver.find_element("css selector", control).is_displayed(), control)
        focus_on(page, control)
        act(page)
        wait_for_focus(page, then)


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


def test_arrow_keys_look_through_the_languages_and_enter_chooses_one_if_the_page_can_load_again(page):
    focus_on(page, "#bar .language")
    page.run("window.load = window.fetch; window.fetch = () => Promise.reject(new TypeError('no connection'))")
    page.tap("ArrowDown")
    page.tap("Enter")
    page.wait_for(lambda: page.run("return document.activeElement.value") == "en", "English again")
    page.run("window.fetch = window.load")
    page.tap("ArrowDown")
    page.tap("Escape")
    assert page.run("return document.activeElement.value") == "en"
    page.tap("ArrowDown")
    assert page.run("return document.activeElement.value === 'de' && 'load' in window")
    page.tap("Enter")
    try:
        page.wait_for(lambda: page.run("return document.documentElement.lang") == "de", "German")
        assert page.run("return document.activeElement.value") == "de"
        page.wait_for_link()
        release(page)  # Escape stops the robots, too
    finally:
        page.run("localStorage.removeItem('language')")
