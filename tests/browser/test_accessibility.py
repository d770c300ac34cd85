"""Everybody can use the pad's page: by keys alone, with a screen reader, and as axe-core's rules ask for."""

from jetbot.wait import wait_until

from .accessibility import tree, violations
from .conftest import OTHER_ROBOT, ROBOT
from .test_access import split
from .test_page import DESKTOP, LONG, TASK
from .test_sharing import codes_of
from .world import moving

BEST = {"type": "scores", "scores": [
    {"task": "One metre", "robot": name, "score": 87.3, "seconds": seconds, "name": "Ada"}
    for name, seconds in ((ROBOT, 3.4), (OTHER_ROBOT, None))]}
OFFER = {"type": "tasks", "tasks": [{"name": "metre", "title": "One metre", "on": True}]}
STOPPED = {"state": "stopped", "status": LONG, "cause": "guard", "warning": True, "stopped": True, "held": "programs",
           "waiting": ["roam"], "stalls": 3}
DRIVING = {"status": "driving", "driver": {"id": 99, "name": "Ben"}, "pictures": {"free": 1, "blocked": 2, "problem": None},
           "task": {**TASK, "state": "done", "text": LONG, "score": 87.3, "seconds": 3.9}}
FOCUSED = "const {activeElement: each} = document; return each.id || each.dataset.robot || each.textContent"
SAID = """window.said = [];
const isLive = (element) => /polite|assertive/.test(live(element));
const live = (element) => element.closest("[aria-live]")?.ariaLive
    ?? {status: "polite", alert: "assertive"}[element.closest("[role=status], [role=alert]")?.role];
new MutationObserver((changes) => said.push(...changes.map(({target}) => target)
    .map((target) => target.nodeType === 3 ? target.parentElement : target)
    .filter(isLive).map((target) => target.textContent).filter(Boolean)))
    .observe(document.body, {subtree: true, childList: true, characterData: true});"""


def drives(page):
    page.receive_class(3, **DRIVING)
    page.receive(BEST)
    page.receive({"type": "notice", "code": "driven", "text": "Ben drives it.", "template": "{driver} drives it.",
                  "arguments": {"driver": "Ben"}})
    page.wait_for_text("notice", "Ben")


def is_stopped(page):
    page.receive_class(3, **STOPPED)
    page.wait_for(lambda: not page.text("task"), "the stop")


def shows_codes(page):
    page.click("#show-codes")
    page.receive(codes_of(3))
    page.receive(OFFER)
    page.click("#codes-tasks summary")
    page.click("#show-teacher")


def loses_the_connection(page):
    page.run("socket.close()")
    page.wait_for(lambda: page.has(".offline"), "the end of the connection")


def asks_for_the_code(page):
    page.run("document.getElementById('login').showModal();"
             "document.getElementById('login-error').textContent = 'This code is wrong.'")


def press(*buttons):
    """Return what presses these buttons, one after the other."""
    return lambda page: [page.click(button) for button in buttons]


def check_rules(page, states):
    found = {}
    for name, act in states.items():
        act(page)
        for scheme in "light", "dark":
            page.media(prefers_color_scheme=scheme, prefers_reduced_motion="reduce")
            found[name, scheme] = violations(page)
    page.media()
    assert [(*state, each) for state, broken in found.items() for each in broken] == []


FIRST = {"connected": lambda page: None, "driving": drives, "stopped": is_stopped}
LAST = {
    "all stopped": lambda page: page.run("document.body.classList.add('emergency')"),
    "the best": press("#show-scores"), "the camera": press("#close-scores", "#show-camera"),
    "no robot": lambda page: page.receive({"type": "robots", "robots": []}), "lost": loses_the_connection,
    "login": asks_for_the_code}
CODES = {"codes": shows_codes, "one code": press("#codes-list .enlarge"), "closed": press("#close-codes", "#close-codes")}


def test_a_teachers_page_on_a_desktop_breaks_no_rule_in_any_of_its_states(page):
    page.resize(*DESKTOP, touch=False)
    check_rules(page, {**FIRST, **CODES, **LAST})


def test_a_teachers_and_a_pupils_page_on_a_phone_break_no_rule_in_any_of_their_states(page, pupil):
    check_rules(page, {**FIRST, "list": press("#show-fleet"), **CODES})
    check_rules(pupil, {**FIRST, **LAST})
