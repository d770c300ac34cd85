"""Who comes from another computer needs a code, and is told if it is wrong."""

import pytest

from .conftest import ROBOT

UNCOVERED = """const width = innerWidth / 9, height = innerHeight / 9;
    return [...Array(64).keys()].map((each) => document.elementFromPoint(
        width * (1 + each % 8), height * (1 + Math.floor(each / 8)))).filter((top) => !top.closest('#login')).length"""

WITHOUT_COOKIES = """window.answers = window.fetch;
    window.fetch = (url, options) => answers(url, {...options, credentials: "omit"})"""


def split(url):
    """Return the address and the code of a pupil's or a teacher's URL."""
    return url.split("#")


def enter(page, code):
    """Type the right code, and wait until the page is connected."""
    page.type("code", code)
    page.wait_for(lambda: not page.text("login"), "the login form to go")
    page.wait_for_link()


def test_the_code_leaves_the_address_bar_and_the_cookie_outlives_a_reload(pupil, world):
    address, _ = split(world.codes()["pupil"])
    assert pupil.run("return location.href") == address
    pupil.open(address, ROBOT)
    world.drive(pupil, ROBOT)
    assert not pupil.run("return document.cookie"), "no script reads the cookie"


@pytest.mark.parametrize("path", ["", "program"])
def test_without_a_cookie_the_page_asks_for_the_code_and_nothing_covers_that(path, pupil, world):
    address, code = split(world.codes()["pupil"])
    pupil.driver.delete_all_cookies()
    pupil.driver.get("about:blank")
    pupil.driver.get(f"{address}{path}#WRONG2")
    pupil.wait_for_text("login-error", "wrong")
    assert ROBOT not in str(pupil.robots())
    pupil.wait_for(lambda: pupil.run(UNCOVERED) == 0, "the form over all")
    pupil.tap("Escape")
    assert {pupil.tab() for _ in range(5)} <= {"code", ""}, "the keyboard does not leave the form"
    pupil.run(WITHOUT_COOKIES)
    pupil.type("code", code)
    pupil.wait_for_text("login-error", "refuses cookies")
    pupil.run("window.fetch = answers")
    enter(pupil, code.lower())
    pupil.choose(ROBOT)
    assert not pupil.has(".emergency"), "Escape in the form stops no robot"


def show_programs(page):
    page.click("#programs")
    page.wait_for(page.element("work").is_displayed, "the sheet")


NUMBER_BOX = "Blockly.getMainWorkspace().getBlocksByType('math_number')[0].getField('NUM').showEditor()"
OPENED = {"the programs": show_programs, "a number": lambda page: page.run(NUMBER_BOX)}


def test_codes_that_change_cost_no_work_and_no_reload_whatever_is_open(pupil, world):
    address, code = split(world.codes()["pupil"])
    pupil.resize(1024, 768)
    pupil.driver.get(f"{address}program")
    pupil.wait_for_link()
    pupil.choose(ROBOT)
    pupil.set("examples", "One metre")
    for name, opens in OPENED.items():
        pupil.driver.delete_all_cookies()
        pupil.type("title", f"Work beside {name}")
        opens(pupil)
        pupil.run("socket.close()")
        pupil.wait_for_text("login-error", "Enter the new one")
        pupil.wait_for(lambda: pupil.run(UNCOVERED) == 0, f"the form over {name}")
        enter(pupil, code)
        assert not pupil.run("return Blockly.WidgetDiv.isVisible()") and not pupil.element("work").is_displayed(), name
    assert pupil.value("title") == f"Work beside {name}"
    pupil.wait_for(lambda: pupil.text("kept") == "Kept", "the work to be kept")
    world.run(pupil, ROBOT)
