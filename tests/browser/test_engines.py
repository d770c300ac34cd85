"""What differs between engines: on iPads is WebKit, on Debian's desktop Firefox. All other tests use Chromium."""

from functools import partial
from importlib import import_module

import pytest
from languages import read

from jetbot.fake.motors import STOPPED

from .conftest import OTHER_ROBOT, ROBOT, need, opened, started
from .test_dead_man import freeze
from .test_driving import hold
from .test_python_safety import hostile, reaches_nothing  # noqa: F401
from .test_stop import release, wait_for_stop
from .world import moving

ENGINES = {  # the programs and modules that each needs, and the packages that have them
    "webkit": ("WebKitWebDriver Xvfb selenium", "webkit2gtk-driver xvfb python3-selenium"),
    "firefox": ("firefox-esr", "firefox-esr"),
}
LANGUAGES = {"webkit": "es-ES", "firefox": "de-DE"}  # that each asks for: all else is in English


@pytest.fixture(scope="session", params=ENGINES)
def engine(request, tmp_path_factory):
    """A function that returns a browser of this engine."""
    need(*ENGINES[request.param])
    browser, language = import_module(f".engine_{request.param}", __package__).Browser, LANGUAGES[request.param]
    with started(lambda _: browser(tmp_path_factory.mktemp("profile"), language)) as get:
        yield partial(get, 1)


@pytest.fixture
def page(engine, world):
    """A teacher's page, with ROBOT chosen; nothing drives before and after the test."""
    yield from opened(engine(), world, world.address)


@pytest.fixture
def programs(engine, world):
    """A teacher's page for programs, with ROBOT chosen."""
    yield from opened(engine(), world, f"{world.address}program")


def drive(page, world, robot=ROBOT):
    """Drive by a mouse whose button stays pressed."""
    world.hold(page, page.hold_mouse, page.let_go_mouse, robot)


def stops_at_release(page, world, let_go, what):
    with world.stops(ROBOT, what=f"the release of {what}"):
        let_go()
    assert page.sent()[-1].is_zero, what


def test_a_mouse_a_finger_and_a_key_drive_until_they_are_let_go(page, world):
    def hold_on():
        drive(page, world)
        world.stay(moving, ROBOT, for_seconds=0.6)  # twice as long as one command counts
    world.undisturbed(page, hold_on)
    assert world.wheels(OTHER_ROBOT) == STOPPED
    stops_at_release(page, world, page.let_go_mouse, "the mouse")
    world.drive(page, ROBOT)
    stops_at_release(page, world, page.lift, "the finger")
    hold("ArrowUp", page, world)
    stops_at_release(page, world, lambda: page.let_go("ArrowUp"), "the key")


def test_a_frozen_browser_stops_the_robot_which_drives_again_only_after_the_mouse_was_let_go(page, world):
    drive(page, world)
    freeze(page, world)
    world.stay_stopped(ROBOT)
    page.let_go_mouse()
    drive(page, world)


def test_a_hidden_page_stops_the_robot_by_its_own_command_at_either_event(page, world):
    for event in "visibilitychange", "blur":
        page.notice_only(event)
        drive(page, world)
        with world.stops(ROBOT, what=event):
            page.hide()
            page.wait_for(lambda: page.sent()[-1].is_zero, f"a last command at {event}")
        page.show()
        page.let_go_mouse()
    drive(page, world)


def test_a_reload_stops_the_robot_and_comes_back_to_it(page, world):
    page.choose(OTHER_ROBOT)
    drive(page, world, OTHER_ROBOT)
    with world.stops(OTHER_ROBOT, what="a reload"):
        page.reload()
    page.wait_for(lambda: page.value("robot") == f"/{OTHER_ROBOT}", "it to be chosen again")
    page.let_go_mouse()


STOPS = {"STOP": lambda page: page.click("#stop"), "Escape": lambda page: page.tap("Escape"),
         "Space": lambda page: page.tap("Space")}


def test_stop_and_its_keys_stop_and_release_lets_nothing_start_by_itself(page, world):
    for name, stop in STOPS.items():
        hold("ArrowUp", page, world)
        with world.stops(ROBOT, what=name):
            stop(page)
        wait_for_stop(page)
        release(page)
        world.stay_stopped(ROBOT)
        page.let_go("ArrowUp")


def test_a_wrong_code_is_refused_and_the_right_one_lets_a_pupil_drive(page, world):
    code = world.codes()["pupil"].partition("#")[2]
    page.load(f"http://127.0.0.2:{world.port}/#WRONG2")  # not by a name of this computer
    wrong = "This code is wrong, or not valid any more. Ask for the new one."
    page.wait_for(lambda: page.text("login-error") == page.say(wrong), wrong)  # which begins in English
    assert ROBOT not in str(page.robots())
    page.errors()  # the refusal
    page.type("code", code.lower())
    page.wait_for_link()
    page.choose(ROBOT)
    drive(page, world)
    page.let_go_mouse()
    page.open(world.address, ROBOT)


def drives_until(programs, world, line, sentence, end_it):
    """Run the program; fail unless this ends it, and the page says so."""
    def act():
        world.run(programs, ROBOT)
        programs.wait_for(lambda: programs.has(line), "the line that runs")
        with world.stops(ROBOT, what=sentence):
            end_it()
        programs.wait_for_text("outcome", programs.say(sentence))
    world.undisturbed(programs, act)


def test_blocks_and_a_text_that_is_edited_drive_until_stop_or_until_their_page_is_hidden(programs, world):
    programs.set("examples", programs.say("A square, with a function"))
    programs.wait_for_text("python", "def side():")
    drives_until(programs, world, "#python .now", "Stopped.", lambda: programs.click("#end"))
    programs.click("#programs")
    programs.click("#new-python")
    programs.wait_for(lambda: "rate.sleep()" in programs.text_of("#text .cm-content"), "the text")
    programs.click("#text .cm-line")
    programs.tap("#")
    programs.wait_for(lambda: programs.text_of("#text .cm-line").count("#") == 2, "what was typed")
    programs.wait_for(lambda: programs.text("kept") == programs.say("Kept"), "it to be kept")
    drives_until(programs, world, "#text .now", "Stopped.", lambda: programs.click("#end"))
    drives_until(programs, world, "#text .now", "The page was hidden, so the program was stopped.",
                 lambda: (programs.hide(), programs.show()))


def test_javascript_in_a_texts_worker_reaches_nothing_either(engine, hostile):  # noqa: F811
    reaches_nothing(engine(), *hostile)


def test_both_pages_are_in_the_browsers_language_and_load_nothing_from_another_address(engine, world, request):
    page, language = engine(), LANGUAGES[request.node.callspec.params["engine"]][:2]
    for path in "", "program":
        page.open(f"{world.address}{path}")
        assert page.run("return document.documentElement.lang") == language
        assert page.text("release") == read(language)["Release"]
        loaded = page.run("return performance.getEntriesByType('resource').map(({ name }) => name)")
        assert loaded and all(url.startswith(world.address) for url in loaded), loaded
