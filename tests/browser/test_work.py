"""Programs that the cockpit keeps, on several pages; and Judge me, from the pupil's press to the score."""

import signal
from contextlib import contextmanager

import pytest

from harness import program

from . import programs
from .conftest import ROBOT
from .programs import as_file, block, chain, num, plug, set_motion
from .world import moving

NOT_COUNTED = "The drive does not count"  # what is said, too, if the page pauses


def open_programs(page, url):
    """Open the page for programs, with ROBOT chosen."""
    page.resize(1024, 768)
    page.driver.get(url)
    page.wait_for_link()
    page.choose(ROBOT)


@pytest.fixture
def page(page, world):
    """A teacher's page for programs on a tablet."""
    open_programs(page, f"{world.address}program")
    return page


@pytest.fixture
def pupil(pupil, world):
    """A pupil's one in another browser, which has the code already."""
    open_programs(pupil, world.codes()["pupil"].partition("#")[0] + "program")
    return pupil


def rename(page, name):
    """Give the shown program a name, and wait until the cockpit has kept that."""
    page.type("title", name)
    page.wait_for(lambda: page.text("kept") == "Kept", f"{name} to be kept")


def names(page):
    """Return the names of the programs that the page lists."""
    if not page.element("work").is_displayed():
        page.click("#programs")
        page.wait_for(page.element("work").is_displayed, "the sheet")
    return page.run("return [...document.querySelectorAll('#work-list li:not(.deleted) .name')]"
                    ".map(name => name.textContent)")


def edit(page):
    """Let the blocks become a text."""
    if not page.has("#edit-question:not([hidden])"):
        page.click("#edit")
        page.wait_for(lambda: page.has("#edit-question"), "the question")
    page.click("#edit-question-yes")
    page.wait_for(lambda: page.has("#text .cm-focused"), "the editor")


def press(page, name, button=".name"):
    """Press a button of a program in the list."""
    page.wait_for(lambda: name in names(page), name)
    page.run("[...document.querySelectorAll('#work-list li')].find(e => e.firstChild.textContent === arguments[0])"
             ".querySelector(arguments[1]).click()", name, button)


def test_of_two_pages_on_one_program_the_older_one_is_told_and_nothing_is_lost(page, pupil):
    rename(page, "")
    assert page.value("title") == "Program", "the name is shown as it is kept"
    rename(page, " <b>Mine</b> ")
    assert page.value("title") == "<b>Mine</b>", "the name is shown as it is kept"
    press(pupil, "<b>Mine</b>")
    pupil.wait_for(lambda: pupil.value("title") == "<b>Mine</b>", "the program to be open")
    rename(pupil, "Theirs")
    page.wait_for_text("kept", "There is a newer version")
    rename(page, "Mine too")
    pupil.wait_for_text("kept", "There is a newer version")
    pupil.click("#newer")
    pupil.wait_for(lambda: pupil.value("title") == "Mine too", "the newer version")
    version = next(name for name in names(page) if name.startswith("Theirs, version "))
    press(page, version)
    page.wait_for(lambda: page.value("title") == "Theirs", "the earlier version")
    press(page, "Mine too", "[aria-label^=Delete]")
    page.wait_for(lambda: not {"Mine too", version} & set(names(page)), "it to be deleted")
    page.run("document.querySelector(\"#work-list [aria-label='Undo: Mine too']\").click()")
    page.wait_for(lambda: {"Mine too", version} <= set(names(page)), "it to be there again")
    pupil.driver.refresh()
    pupil.wait_for_link()
    assert pupil.value("title") == "Mine too"


def judge(pupil, world, sentence, act=None):
    """Press Judge me, and do this while the robot drives; again only if the page paused: fail unless it says this."""
    not_counted = pupil.say(f"{NOT_COUNTED}.").strip(".")

    def press():
        pupil.click("#judge")
        pupil.wait_for(lambda: not_counted not in pupil.text("score"), "another judging")
        if act:
            pupil.wait_for_text("score", "The judge measures")
            world.wait_for(lambda: moving(*world.wheels(ROBOT)), 20.0, "the drive")
            act()
        pupil.wait_for(lambda: sentence in pupil.text("score") or not_counted in pupil.text("score"), sentence,
                       within=60.0)
        assert sentence in pupil.text("score")
    world.undisturbed(pupil, press)


@contextmanager
def suspended(process):
    """Suspend a process in this context."""
    process.send_signal(signal.SIGSTOP)
    yield
    process.send_signal(signal.SIGCONT)


THERE = plug("logic_compare", {"OP": "LT"}, A=plug("robot_here", {"WHAT": "X"}), B=num(0.95))
ENDLESS = programs.program(block("robot_loop", DO=chain(
    set_motion(0, 0), block("controls_if", IF0=THERE, DO0=chain(set_motion(0.4, 0))))))


def test_judge_me_puts_the_robot_at_its_start_runs_the_program_and_shows_the_score(page, pupil, world, tmp_path):
    process = world.start(program("driving_tasks", "class_judge.py"))
    page.click("#overview-button")
    page.wait_for(lambda: page.has("#task-switches input"), "the tasks")
    assert not pupil.element("judge").is_displayed(), "no task is on"
    page.click("#task-switches input")
    pupil.wait_for(lambda: pupil.element("judge").is_displayed(), "the task")
    pupil.element("file").send_keys(as_file(tmp_path, ENDLESS))
    pupil.wait_for_text("python", "if here.x < 0.95:")
    for stop in (lambda: pupil.click("#end"), lambda: page.click("#stop")):
        with suspended(process), world.stops(ROBOT, what="a stop before the robot is at its start"):
            pupil.click("#judge")
            stop()
            pupil.wait_for_text("score", "cancelled")
    page.click("#release")
    pupil.wait_for(lambda: not pupil.has("#release.needed"), "the release")
    judge(pupil, world, "the program was paused", lambda: pupil.click("#pause"))
    pupil.click("#end")
    judge(pupil, world, "points")
    assert "Largest loss" in pupil.text("score") and "One metre" in pupil.text("score")
    page.wait_for_text("score-table", "One metre")
    world.kill(process)


def test_what_is_saved_arrives_from_a_computer_without_https_and_who_gets_no_list_reads_why(page, world):
    rename(page, "Mine")
    open_programs(page, world.codes()["teacher"].replace("#", "program#"))
    assert not page.run("return isSecureContext")
    page.wait_for(lambda: page.value("title") == "Mine", "the program")
    assert "import rospy" in page.download("package", "my_mine.txt").read_text()
    assert "robot_start" in page.download("save", "my_mine.json").read_text()
    page.click("#overview-button")
    assert "Mine.json" in page.download("download-all", "programs.txt").read_text()
    page.tap("Escape")
    page.run("window.fetch = async () => { throw new TypeError('no network'); }")
    page.click("#overview-button")
    page.wait_for_text("overview-problem", "The cockpit does not answer.")
