"""Both pages in each of their states, on each screen, in a language with longer words than any real one.

In each state no English is left, nothing is cut off, covered, overlapping, too small or beside the screen, the Tab key
reaches each control, and axe-core's rules hold by day and by night.
"""

import pytest

from jetbot_cockpit.notices import say
from jetbot_control_node.status.remarks import remark
from jetbot_ros.state import CAUSES

from . import pseudo_language
from .accessibility import RULES, violations
from .conftest import ROBOT
from .messages import BEN, BEST, DONE, LONG, TASKS, codes_of, receive_fleet
from .programs import block, calculate, drive, num, plug, program, show, wait
from .pseudo_language import KNOWN
from .screens import DESKTOP, FINGER, MOUSE
from .test_python_page import suggested, type_at_end
from .test_work import edit

SCREENS = [  # px
    (360, 640), (320, 568), (390, 844), (844, 390), (820, 1180), (1180, 820), (640, 400), (400, 300), DESKTOP]
WITH_MOUSE = DESKTOP, (640, 400)
NAME = "a_robot_with_a_name_of_forty_characters_"
LONG_TEXTS = f"""document.getElementById('notice').textContent = '[{LONG}]';
    document.getElementById('notice').hidden = false;
    for (const each of document.querySelectorAll('#robot option, #fleet .label')) each.textContent = '[{NAME}]'"""


def press(*buttons):
    """Return what presses these buttons, one after the other."""
    return lambda page: [page.click(f"#{button}") for button in buttons]


def drives(page):
    page.receive_class(3, driver={**BEN, "name": "[" + "W" * 18 + "]"}, stalls=3, task=DONE,
                       remarks=[remark("too_slow")._asdict()], pictures={"free": 1, "blocked": 2, "problem": None})
    page.receive(BEST)
    page.receive({"type": "notice", **say("driven", driver=say("pupil", number=2), robot=ROBOT).fields()})


def has_long_texts(page):
    drives(page)
    page.run(LONG_TEXTS)


def waits(page):
    page.receive_class(3, state="stopped", status="?", cause="zero", template=CAUSES["zero"], arguments={},
                       fake=True, stopped=True, held="programs", waiting=["/jetbot_01"], task=DONE)


def is_of_a_hub(page):
    receive_fleet(page, ["jetbot_03", "jetbot_09"])
    page.choose("jetbot_04")
    page.click("#show-health")
    page.wait_for(lambda: page.text("unconfirmed"), "the robots that have not confirmed")


def shows_codes(page):
    page.click("#show-codes")
    cards = codes_of(3)["codes"]
    page.receive({"type": "codes", "codes": [*cards, {**cards[0], "label": "pupils", "robot": None}]})
    page.receive(TASKS)
    page.click("#codes-tasks summary")


def asks_for_the_code(page):
    page.run("dispatchEvent(new Event('ask')); document.getElementById('login').showModal();"
             "document.getElementById('login-error').textContent = '[This code is wrong.]'")


def loses_the_connection(page):
    page.run("window.WebSocket = class { close() {} }; socket.close()")
    page.wait_for(lambda: page.has(".offline"), "the end of the connection")


PAD = {  # what leads to each state from the one before
    "connected": lambda page: None, "driven": drives, "long texts": has_long_texts, "waiting": waits,
    "list": lambda page: page.run("document.getElementById('show-fleet').click()"),
    "codes": shows_codes, "one code": lambda page: page.click("#codes-list .enlarge"),
    "hub": lambda page: (press("close-codes", "close-codes")(page), is_of_a_hub(page)),
    "camera": press("show-camera"), "best": lambda page: (drives(page), page.click("#show-scores")),
    "no robot": lambda page: (page.click("#close-scores"), page.receive({"type": "robots", "robots": []})),
    "lost": loses_the_connection, "login": asks_for_the_code}


def opens(content):
    return lambda page: page.open_file(content)


def runs(content, outcome):
    """Return what runs a program, and waits for what is said of it."""
    def act(page):
        page.open_file(content)
        page.click("#run")
        page.wait_for_text("outcome", outcome)
    return act


def in_blocks(*keys):
    """Return what presses keys in the blocks, from the block that turns on."""
    def act(page):
        page.tap("Escape")
        page.tab_to("run")
        page.tap("w", "ArrowDown", "ArrowDown", "ArrowDown", *keys)
    return act


def menu(page):
    in_blocks()(page)
    page.press("Control")
    page.tap("Enter")
    page.let_go("Control")
    page.wait_for(lambda: page.has(".blocklyContextMenu"), "the menu")


def judged(page):
    page.click("#end")
    page.receive(TASKS)
    page.run("document.getElementById('judge').click()")
    page.wait_for_text("score", "No judge has this task")


def opens_sheet(name, sheet):
    def act(page):
        page.receive(BEST)
        page.click(f"#{name}")
        page.wait_for(page.element(sheet).is_displayed, sheet)
    return act


def suggests(page):
    type_at_end(page, "\nrospy.")
    page.wait_for(lambda: suggested(page), "suggestions")


TURN = program(drive(0.5, 1), block("robot_turn", {"SIDE": "LEFT"}, Z=num(0.2), SECONDS=num(1)))
ENDLESS = program(block("controls_whileUntil", {"MODE": "WHILE"}, BOOL=plug("logic_boolean", {"BOOL": "TRUE"}),
                        DO={"block": wait(1)}))
FAILS = program(drive(0.4, 0.4), show(calculate("DIVIDE", num(1), num(0))))
EXAMPLE = """const all = document.getElementById('examples'); all.selectedIndex = 7;
    all.dispatchEvent(new Event('change'))"""
PROGRAMS = {
    "no blocks": opens(program()),
    "an example": lambda page: page.run(EXAMPLE),
    "kinds of blocks": lambda page: (page.tab_to("run"), page.tap("t", "ArrowDown", "ArrowRight")),
    "blocks": opens(TURN),
    "a choice": in_blocks("ArrowRight", "Enter"),
    "a number": in_blocks("ArrowRight", "ArrowRight", "ArrowRight", "Enter"),
    "a menu": menu,
    "a move": in_blocks("m"),
    "ended by an error": runs(FAILS, "divides by 0"),
    "running": runs(ENDLESS, "Running"),
    "judged": judged,
    "Programs": opens_sheet("programs", "work"),
    "Class": opens_sheet("overview-button", "overview"),
    "map": lambda page: (page.tap("Escape"), page.has("#show-map[aria-pressed=true]") or page.click("#show-map")),
    "question": lambda page: (page.click("#show-map"), page.click("#edit")),
    "text": edit,
    "suggestions": suggests,
    "text that failed": runs({**program(), "python": "def f(x)\n    return 'ä' + 1 / x  # 0\n"}, "colon"),
    "way back": press("to-blocks"),
    "login": asks_for_the_code}
# A pupil's page is a teacher's without some buttons: in these states it has another layout
PUPILS_PAD = "connected", "driven", "waiting", "camera", "lost", "login"
PUPILS_PROGRAMS = "no blocks", "judged", "Programs", "login"


@pytest.mark.parametrize("path, states", [("", PAD), ("program", PROGRAMS)], ids=["pad", "programs"])
def test_a_teachers_page(path, states, page, world):
    check(page, f"{world.address}{path}", states)


@pytest.mark.parametrize("path, states", [
    ("", {name: PAD[name] for name in PUPILS_PAD}), ("program", {name: PROGRAMS[name] for name in PUPILS_PROGRAMS}),
], ids=["pad", "programs"])
def test_a_pupils_page(path, states, pupil, world):
    check(pupil, world.codes()["pupil"].replace("#", f"{path}#"), states)


ABSENT = """#show-fleet, #fleet *, .covered :is(#view, #wheels, #steering, #limit) *, .looking #tools *,
    .enlarged :is(#bar, #codes-cameras, #codes-tasks) *, details:not([open]) *"""  # of a pad, on some screen
ON_PHONES = ", #save, #package, #open, #pace *, [id^=show-], #edit, #side #tools *"  # of a page for programs
OF_REAL_LANGUAGES = "label-content-name-mismatch"  # [Stop s] is not in [Stop jetbot_01 p]
# Only the blocks differ from "no blocks", or have the keys
IN_BLOCKS = {"an example", "blocks", "a choice", "a number", "a menu", "a move"}
IN_A_TEXT = {"text", "suggestions", "text that failed"}  # which has the Tab key


def look(page, state):
    """Return what is wrong with a page in its present state."""
    found = [f"English: {text}" for text in page.untranslated(*KNOWN)]
    for scheme, screens, rules in ("dark", SCREENS[:5], RULES), ("light", SCREENS[5:], ["color-contrast"]):
        page.media(prefers_color_scheme=scheme, prefers_reduced_motion="reduce")
        for width, height in screens[-1:] if state in IN_BLOCKS else screens:
            page.resize(width, height, touch=(width, height) not in WITH_MOUSE)
            absent = ABSENT + ON_PHONES * (width <= 700 or height <= 500)
            least = MOUSE if (width, height) in WITH_MOUSE else FINGER
            found += [f"on {width} x {height}, {fault}" for fault in page.faults(least, absent)]
        found += [f"on {width} x {height}, {scheme}: {rule}" for rule in violations(page, OF_REAL_LANGUAGES, rules)]
    if state not in IN_BLOCKS | IN_A_TEXT:
        found += [f"the Tab key does not reach {control}" for control in page.unreached()]
    return found


def check(page, url, states):
    """Bring a page into each state, and look at it on each screen."""
    found = []
    with pseudo_language.spoken(page):
        page.driver.get("about:blank")  # the same address with another code would load nothing
        page.open(url, ROBOT)
        for name, act in states.items():
            page.resize(*DESKTOP, touch=False)
            act(page)
            found += [f"{name}: {fault}" for fault in look(page, name)]
    assert not found, "\n".join(found)
