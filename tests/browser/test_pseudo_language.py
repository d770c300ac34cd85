"""Both pages in a language that nobody speaks: its words are in brackets and 40 % longer than the English ones.

Texts without brackets are English that is not translated; and what is longer must not be cut off, nor cover another.
"""

import json
import re

import pytest
from languages import keys, messages

from jetbot_cockpit.notices import say
from jetbot_control_node.status.remarks import remark
from jetbot_ros.state import CAUSES

from .conftest import ROBOT
from .hub_class import receive_fleet
from .test_accessibility import BEN, BEST, OFFER, press
from .test_sharing import codes_of

SCREENS = [(360, 640), (820, 1180), (1024, 768), (1280, 800)]  # px
SHEETS = "codes", "one code", "best", "programs", "class", "way back"  # states in which a sheet covers the page
KNOWN = ["jetbot", "ms", "rad", "Ben", "Ada", "Maximilian", "STOP", "http", "KQ", "MX"]
SPEAK = """if (location.protocol === "http:") {
    const pseudo = %s, fetch = window.fetch;
    localStorage.setItem("language", "de");
    window.fetch = (url, ...more) => String(url).endsWith("/languages/de.json")
        ? Promise.resolve(new Response(JSON.stringify(pseudo))) : fetch(url, ...more);
}"""


def stretch(english):
    """Return a sentence in the pseudo-language, in each of its forms: with its own letters again, backwards."""
    def longer(form):
        letters = re.sub(r"\{\w+\}|%\d|[^a-z ]", "", form.lower())[::-1]
        return f"[{form} {letters[:max(1, len(form) * 2 // 5 - 2)].strip()}]"
    return "|".join(map(longer, english.split("|")))


@pytest.fixture
def pseudo(page):
    """A function that opens a page in the pseudo-language."""
    said = {key: stretch(key) for key in {*keys("de"), *messages("en").values()} - {"STOP"}}
    devtools = page.driver.execute_cdp_cmd
    devtools("Network.enable", {})
    devtools("Network.setBlockedURLs", {"urls": ["*/msg/de.js"]})
    script = devtools("Page.addScriptToEvaluateOnNewDocument", {"source": SPEAK % json.dumps(said)})

    def load(url):
        page.open(url, ROBOT)
        return page
    yield load
    devtools("Page.removeScriptToEvaluateOnNewDocument", script)
    devtools("Network.setBlockedURLs", {"urls": []})
    page.run("localStorage.removeItem('language')")
    page.errors()  # of the file that was not loaded


def check(page, states):
    """Bring the page into each state, and look at it on each screen."""
    found = []
    for name, act in states.items():
        act(page)
        found += [f"{name}: English: {text}" for text in page.untranslated(*KNOWN)]
        for screen in SCREENS:
            page.resize(*screen, touch=screen[0] < 1280)
            found += [f"{name} on {screen}: {text} is cut off" for text in page.cut_words()]
            found += [f"{name} on {screen}: {pair} overlap" for pair in page.overlapping() if name not in SHEETS]
            found += [f"{name} on {screen}: {control} is beside it" for control in page.beside_screen()]
            found += [f"{name} on {screen}: it scrolls sideways"] * (not page.fits())
    assert not found, "\n".join(found)


def drives(page):
    low = [remark("too_slow")._asdict()]
    page.receive_class(3, driver=BEN, stalls=3, remarks=low, pictures={"free": 1, "blocked": 2, "problem": None}, task={
        "name": "metre", "title": "One metre", "state": "done", "text": "", "sentences": [], "lost": None,
        "seconds": 3.9, "score": 87.3})
    page.receive(BEST)
    page.receive({"type": "notice", **say("driven", driver=say("pupil", number=2), robot=ROBOT).fields()})


def is_stopped(page):
    page.receive_class(3, state="stopped", status="?", cause="zero", template=CAUSES["zero"], arguments={},
                       stopped=True, held="programs", waiting=["/jetbot_01"])


def is_of_a_hub(page):
    receive_fleet(page, ["jetbot_03", "jetbot_09"])
    page.choose("jetbot_04")
    page.click("#show-health")
    page.wait_for(lambda: page.text("unconfirmed"), "the robots that have not confirmed")


def shows_codes(page):
    page.click("#show-codes")
    cards = codes_of(3)["codes"]
    page.receive({"type": "codes", "codes": [*cards, {**cards[0], "label": "pupils", "robot": None}]})
    page.receive(OFFER)
    page.click("#codes-tasks summary")


def test_the_pads_page_has_no_english_left_and_room_for_longer_words(pseudo, world):
    check(pseudo(world.address), {
        "connected": lambda page: None, "hub": is_of_a_hub, "driven": drives, "stopped": is_stopped,
        "codes": shows_codes,
        "one code": press("#codes-list .enlarge"), "best": press("#close-codes", "#close-codes", "#show-scores"),
        "camera": press("#close-scores", "#show-camera"),
        "login": lambda page: page.run("document.getElementById('login').showModal()")})


def test_the_page_for_programs_has_no_english_left_and_room_for_longer_words(pseudo, world):
    check(pseudo(f"{world.address}program"), {
        "connected": press("#programs", "#new"),  # the robot may have programs of other tests
        "example": lambda page: page.run("const examples = document.getElementById('examples');"
                                         "examples.selectedIndex = 7; examples.dispatchEvent(new Event('change'))"),
        "programs": press("#programs"), "class": press("#close-work", "#overview-button"),
        "map": press("#close-overview", "#show-map"), "question": press("#show-map", "#edit"),
        "text": press("#edit-question-yes", "#text [aria-label^='[Indent']"), "way back": press("#to-blocks")})
