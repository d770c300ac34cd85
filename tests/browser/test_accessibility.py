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
STOPPED = {"state": "stopped", "status": LONG, "warning": True, "stopped": True, "held": "programs",
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


def stops(page):
    page.receive_class(3, **STOPPED)


def stops_all(page):
    page.run("document.body.classList.add('emergency')")


def opens(button):
    return lambda page: page.element(button).is_displayed() and page.click(f"#{button}")


def shows_codes(page):
    page.click("#show-codes")
    page.wait_for(lambda: page.has("#codes-list li"), "the codes")
    page.receive(codes_of(3))
    page.receive(OFFER)
    page.click("#codes-tasks summary")
    page.click("#show-teacher")


def asks_for_the_code(page):
    page.run("dispatchEvent(new Event('ask')); document.getElementById('login').showModal();"
             "document.getElementById('login-error').textContent = 'This code is wrong.'")


STATES = {"connected": lambda page: None, "driving": drives, "stopped": stops, "all stopped": stops_all,
          "list": opens("show-fleet"), "best": opens("show-scores"), "best closed": opens("close-scores"),
          "camera": opens("show-camera"), "no robot": lambda page: page.receive({"type": "robots", "robots": []}),
          "lost": lambda page: page.run("socket.close()"), "login": asks_for_the_code}
TEACHERS = {**STATES, "best closed": lambda page: shows_codes(page), "camera": opens("show-camera")}
