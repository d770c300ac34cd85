"""Who comes from another computer needs a code; no other web site gets in."""

import functools
import threading
from http.server import HTTPServer, SimpleHTTPRequestHandler

import pytest

from .conftest import ROBOT
from .world import FOREIGN, World

SOCKET = """const [url, done] = arguments, socket = new WebSocket(url);
    socket.onopen = () => done("open"); socket.onclose = ({code}) => done(code);"""
LOGIN = """const [url, code, done] = arguments;
    fetch(url, {method: "POST", mode: "no-cors", credentials: "include", body: JSON.stringify({code})})
        .then(() => done("sent"), () => done("failed"));"""


@pytest.fixture(scope="module")
def empty_world(browsers, tmp_path_factory):
    """A cockpit without a robot."""
    world = World(tmp_path_factory.mktemp("empty_world"))
    yield world
    world.close()


@pytest.fixture
def foreign_site(tmp_path):
    """The address of a web site on another port of this computer."""
    (tmp_path / "index.html").write_text("<p>another site</p>")
    server = HTTPServer(("127.0.0.1", 0), functools.partial(QuietHandler, directory=str(tmp_path)))
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    yield f"http://localhost:{server.server_port}/"
    server.shutdown()
    thread.join()
    server.server_close()


class QuietHandler(SimpleHTTPRequestHandler):
    """Logs nothing."""

    def log_message(self, *_):
        pass


def test_the_code_leaves_the_address_bar_and_the_cookie_outlives_a_reload(pupil, world):
    where = world.codes()["pupil"].partition("#")[0]
    assert pupil.run("return location.href") == where
    pupil.open(where, ROBOT)
    world.drive(pupil, ROBOT)
    pupil.lift()
    assert not pupil.run("return document.cookie"), "no script reads the cookie"


def test_without_a_cookie_the_page_asks_for_the_code_and_shows_nothing_else(pupil, world):
    pupil.driver.delete_all_cookies()
    pupil.driver.get("about:blank")
    pupil.driver.get(world.codes()["pupil"].partition("#")[0])
    pupil.wait_for(lambda: pupil.element("login").is_displayed() and pupil.text("login"), "the login form")
    assert not pupil.robots() or ROBOT not in str(pupil.robots())
    assert pupil.run("return document.getElementById('cockpit').inert")
    pupil.log_in(world.codes()["pupil"].partition("#")[2].lower())
    pupil.wait_for(lambda: not pupil.element("login").is_displayed(), "the login form to go")
    pupil.wait_for_link()


def test_another_site_in_the_same_browser_gets_no_socket_and_no_cookie(page, world, foreign_site):
    cockpit = world.address.partition("//")[2]
    assert page.run_async(SOCKET, f"ws://{cockpit}socket") == "open", "the page itself does"
    page.driver.get(foreign_site)
    page.driver.delete_all_cookies()
    assert page.run_async(SOCKET, f"ws://{cockpit}socket") == 1006
    page.run_async(LOGIN, f"{world.address}login", world.codes()["teacher"].partition("#")[2])
    assert page.driver.get_cookies() == []
    page.errors()


def test_a_foreign_name_that_leads_here_shows_nothing(page, world):
    page.driver.get(f"http://{FOREIGN}:{world.port}/")
    assert not page.run("return document.getElementById('cockpit')")
    page.errors()


def test_without_a_robot_the_page_says_so(empty_world, browsers):
    page = browsers(1)
    page.open(empty_world.address)
    page.wait_for_text("status", "no robot")
    page.leave()


def test_wrong_codes_are_refused_and_after_five_the_right_one_too(empty_world, browsers):
    page, codes = browsers(1), empty_world.codes()
    page.driver.get(codes["pupil"].partition("#")[0] + "#WRONG2")
    page.wait_for_text("login", "code")
    page.wait_for(lambda: "wrong" in page.everything(), "a sentence about the wrong code")
    for _ in range(4):
        page.log_in("WRONG3")
    page.log_in(codes["pupil"].partition("#")[2])
    page.wait_for(lambda: "minute" in page.everything(), "a sentence about too many tries")
    page.leave()
    page.errors()
