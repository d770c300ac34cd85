"""What matters most, in each engine: on iPads is WebKit, on Debian's desktop Firefox.

In Chromium, which all other tests use, only what they do not show runs without --long.
"""

import signal
from functools import partial
from importlib import import_module

import pytest
from languages import read

from harness import program
from jetbot.fake.motors import STOPPED
from processes import end

from .conftest import OTHER_ROBOT, ROBOT, need, opened, some, started
from .test_dead_man import freeze
from .test_driving import KEYS, hold
from .test_stop import release, wait_for_stop
from .test_work import judge
from .world import moving

ENGINES = {  # the programs and modules that each needs, and the packages that have them
    "chromium": ("chromium chromedriver selenium", "chromium chromium-driver python3-selenium"),
    "webkit": ("WebKitWebDriver Xvfb selenium", "webkit2gtk-driver xvfb python3-selenium"),
    "firefox": ("firefox-esr", "firefox-esr"),
}
WRONG = "This code is wrong, or not valid any more. Ask for the new one."
LANGUAGES = {"chromium": "fr-FR", "webkit": "es-ES", "firefox": "de-DE"}  # that each asks for: all else is in English


in_all = pytest.mark.parametrize("engine", ENGINES, indirect=True)


@pytest.fixture(scope="session", params=some(ENGINES, "webkit", "firefox"))
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


@pytest.fixture
def victim(engine, world):
    """A browser that may be frozen or killed, with a mouse that drives ROBOT."""
    victim = engine()
    victim.open(world.address, ROBOT)
    drive(victim, world)
    yield victim
    if victim.runs:
        victim.leave()


def drive(page, world):
    """Drive by a mouse whose button stays pressed."""
    world.hold(page, page.hold_mouse, page.let_go_mouse, ROBOT)


@in_all
def test_a_mouse_drives_until_its_button_is_let_go(page, world):
    def hold_on():
        drive(page, world)
        world.stay(moving, ROBOT, for_seconds=0.6)  # twice as long as one command counts
    world.undisturbed(page, hold_on)
    with world.stops(ROBOT, what="the mouse's release"):
        page.let_go_mouse()
    assert page.sent()[-1].is_zero
    assert world.wheels(OTHER_ROBOT) == STOPPED


def test_a_finger_drives_until_it_is_lifted(page, world):
    world.drive(page, ROBOT)
    with world.stops(ROBOT, what="the finger's release"):
        page.lift()
    assert page.sent()[-1].is_zero


def test_keys_drive_until_they_are_let_go(page, world):
    for key in "ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight":
        hold(key, page, world, KEYS[key])
        with world.stops(ROBOT, what=f"the release of {key}"):
            page.let_go(key)


def test_a_frozen_browser_stops_the_robot_which_drives_again_only_after_the_mouse_was_let_go(victim, world):
    freeze(victim, world)
    world.stay_stopped(ROBOT)
    victim.let_go_mouse()
    drive(victim, world)


def test_a_killed_browser_stops_the_robot(victim, world):
    with world.stops(ROBOT, what="SIGKILL of the browser"):
        victim.signal(signal.SIGKILL)


@pytest.mark.parametrize("event", ["visibilitychange", "blur"])
@in_all
def test_a_page_that_is_hidden_stops_the_robot_by_its_own_command_at(event, page, world):
    page.notice_only(event)
    drive(page, world)
    with world.stops(ROBOT, what=event):
        page.hide()
    page.show()
    assert page.sent()[-1].is_zero
    page.let_go_mouse()
    drive(page, world)


def test_a_reload_stops_the_robot_and_comes_back_to_it(page, world):
    page.choose(OTHER_ROBOT)
    world.hold(page, page.hold_mouse, page.let_go_mouse, OTHER_ROBOT)
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


ENDS = {"Stopped.": lambda page: page.click("#end"),
        "The page was hidden, so the program was stopped.": lambda page: (page.hide(), page.show())}


def test_a_program_drives_until_stop_or_until_its_page_is_hidden(programs, world):
    programs.set("examples", programs.say("A square, with a function"))
    programs.wait_for_text("python", "def side():")
    drives_until_each_end(programs, world, "#python .now")


def drives_until_each_end(programs, world, line):
    def drives_until(sentence, end_it):
        world.run(programs, ROBOT)
        programs.wait_for(lambda: programs.has(line), "the line that runs")
        with world.stops(ROBOT, what=sentence):
            end_it(programs)
        programs.wait_for_text("outcome", programs.say(sentence))
    for sentence, end_it in ENDS.items():
        world.undisturbed(programs, partial(drives_until, sentence, end_it))


def test_a_text_is_edited_and_drives_until_stop_or_until_its_page_is_hidden(programs, world):
    programs.click("#programs")
    programs.click("#new-python")
    programs.wait_for(lambda: "rate.sleep()" in programs.text_of("#text .cm-content"), "the text")
    programs.click("#text .cm-line")
    programs.tap("#")
    programs.wait_for(lambda: programs.text_of("#text .cm-line").count("#") == 2, "what was typed")
    programs.wait_for(lambda: programs.text("kept") == programs.say("Kept"), "it to be kept")
    drives_until_each_end(programs, world, "#text .now")


@pytest.fixture
def class_judge(world):
    """The judge of the driving tasks."""
    process = world.start(program("driving_tasks", "class_judge.py"))
    yield
    end([process])


@pytest.mark.long
def test_judge_me_gives_a_score(programs, world, class_judge):
    metre = programs.say("One metre")
    programs.set("examples", metre)
    judge(programs, world, metre)


def test_nothing_is_loaded_from_another_address(page, world):
    for path in "", "program":
        page.open(f"{world.address}{path}", ROBOT)
        loaded = page.run("return performance.getEntriesByType('resource').map(({ name }) => name)")
        assert loaded
        assert {url for url in loaded if not url.startswith(world.address)} == set()


@in_all
def test_both_pages_are_in_the_language_that_the_browser_asks_for(engine, world, request):
    language = LANGUAGES[request.node.callspec.params["engine"]][:2]
    for path in "", "program":
        engine().open(f"{world.address}{path}")
        assert engine().run("return document.documentElement.lang") == language
        assert engine().text("release") == read(language)["Release"]
