"""Who comes from another computer needs a code, and is told if it is wrong."""

from .conftest import ROBOT


def split(url):
    """Return the address and the code of a pupil's or a teacher's URL."""
    return url.split("#")


def test_the_code_leaves_the_address_bar_and_the_cookie_outlives_a_reload(pupil, world):
    address, _ = split(world.codes()["pupil"])
    assert pupil.run("return location.href") == address
    pupil.open(address, ROBOT)
    world.drive(pupil, ROBOT)
    assert not pupil.run("return document.cookie"), "no script reads the cookie"


def test_without_a_cookie_the_page_asks_for_the_code_and_shows_nothing_else(pupil, world):
    address, code = split(world.codes()["pupil"])
    pupil.driver.delete_all_cookies()
    pupil.driver.get("about:blank")
    pupil.driver.get(f"{address}#WRONG2")
    pupil.wait_for_text("login-error", "wrong")
    assert ROBOT not in str(pupil.robots())
    assert pupil.run("return document.getElementById('cockpit').inert")
    pupil.type("code", code.lower())
    pupil.wait_for(lambda: not pupil.text("login"), "the login form to go")
    pupil.wait_for_link()
