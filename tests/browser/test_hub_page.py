"""The page of a class of real robots, served by a hub: each robot has a ROS master and a cockpit of its own."""

import re
from base64 import b64decode

import pytest

from jetbot.fake.motors import STOPPED
from jetbot.wait import wait_until

from .conftest import need
from .messages import codes_of, numbered, receive_fleet
from .programs import as_file, drive, program
from .real_class import RealClass
from .screens import DESKTOP
from .test_accessibility import LISTEN

ONE, OTHER, THIRD = ROBOTS = "jetbot_01", "jetbot_02", "jetbot_03"
PHONE, LYING = (360, 640), (1024, 768)  # px
BACK_WITHIN = 60.0  # s until a robot's programs have started
CARDS = """return [...document.querySelectorAll("#codes-list li")].map((card) => ["h3", ".address", ".code"].map(
  (part) => card.querySelector(part).textContent))"""
PAGE = re.compile(rb"/Type\s*/Page\b")
ROW = "#fleet li[data-robot='/{}']"


@pytest.fixture(scope="module")
def robots(tmp_path_factory):
    """Three real robots and a hub."""
    robots = RealClass(tmp_path_factory.mktemp("class"), *ROBOTS)
    yield robots
    robots.close()


@pytest.fixture
def page(robots, tmp_path_factory, browsers):
    """The teacher's page at the hub, on a desktop."""
    need("chromium chromedriver selenium", "chromium chromium-driver python3-selenium")
    page = browsers(1)
    page.open(robots.address)
    page.resize(*DESKTOP, touch=False)
    page.wait_for(lambda: all(is_here(page, robot) for robot in ROBOTS), "all robots", within=BACK_WITHIN)
    page.choose(ONE)
    page.errors()
    yield page
    errors = page.errors()
    page.open(robots.address)
    page.send({"type": "release", "robot": None})
    page.leave()
    assert errors == []


def level(page, robot):
    """Return how a robot's row in the list shows it."""
    return page.run("return document.querySelector(arguments[0])?.dataset.level", ROW.format(robot))


def is_here(page, robot):
    return level(page, robot) not in (None, "away") and "answer" not in page.text_of(f"{ROW.format(robot)} .why")


def hold(page, robots, robot):
    """Hold the pad until the wheels of the robot turn."""
    for _ in range(5):  # on a busy computer its switch may rightly fire
        page.touch()
        try:
            return robots.wait_for(lambda: robots.wheels(robot) != STOPPED, f"{robot} to drive", within=3.0)
        except AssertionError:
            page.lift()
    raise AssertionError(f"{robot} does not drive: {page.text('body')}{robots.logs()}")


def test_a_teacher_drives_one_robot_through_the_hub_and_it_stops_when_the_page_is_gone(page, robots):
    page.resize(*LYING)
    for robot in ONE, OTHER:
        page.choose(robot)
        hold(page, robots, robot)
        others = [each for each in ROBOTS if each != robot]
        assert [robots.wheels(each) for each in others] == [STOPPED] * 2
        page.wait_for_text("status", "You drive it")
        page.driver.get("about:blank")
        robots.wait_for(lambda robot=robot: robots.wheels(robot) == STOPPED, f"{robot} to stop", within=2.0)
        page.open(robots.address, ONE)
        page.resize(*LYING)
        page.lift()


def test_stop_names_the_robot_that_was_killed_until_it_is_back_and_stopped(page, robots):
    page.run(LISTEN)
    robots.kill_robot(THIRD)
    page.wait_for(lambda: not is_here(page, THIRD), "the loss of the robot")
    page.click("#stop")
    page.wait_for_text("unconfirmed", f"Stopped: 2 of 3. Not confirmed: {THIRD}. Use their own switches.")
    assert [level(page, robot) for robot in (ONE, OTHER)] == ["stopped"] * 2
    assert level(page, THIRD) in ("away", "warning"), "nobody knows whether it is stopped"
    assert any(THIRD in text for text in page.run("return said")), "a screen reader says it"
    assert page.run("return document.getElementById('unconfirmed').role") == "alert"
    robots.start_robot(THIRD)
    page.wait_for(lambda: not page.text("unconfirmed"), f"{THIRD} to be back", within=BACK_WITHIN)
    page.wait_for(lambda: level(page, THIRD) == "stopped", f"{THIRD} to be stopped")
    page.choose(THIRD)
    page.wait_for(lambda: page.touch() or wait_until(  # again, as the pad may just have moved
        lambda: "must be released first" in page.text("notice"), 2.0), "the refusal")
    assert robots.wheels(THIRD) == STOPPED
    page.lift()
    page.click("#release")
    page.wait_for(lambda: level(page, THIRD) != "stopped", "the release")
    hold(page, robots, THIRD)
    page.lift()


def test_the_cards_open_by_themselves_with_each_robots_own_address(page, robots):
    page.open(f"{robots.address}?codes")
    page.wait_for(lambda: len(page.run(CARDS)) == len(ROBOTS), "a card of each robot")
    cards = page.run(CARDS)
    assert [card[0] for card in cards] == list(ROBOTS)
    assert [card[1].rstrip("/").rpartition(":")[2] for card in cards] == [str(robots.port_of(each)) for each in ROBOTS]
    assert all(card[2] for card in cards) and page.driver.current_url == robots.address


def test_the_cards_of_fifteen_robots_are_one_sheet_of_paper(page):
    receive_fleet(page)
    page.click("#show-codes")
    page.receive(codes_of(15))
    assert [card[0] for card in page.run(CARDS)] == numbered(15) and len({card[1] for card in page.run(CARDS)}) == 15
    from selenium.webdriver.common.print_page_options import PrintOptions
    a4 = PrintOptions()
    a4.page_height, a4.page_width = 29.7, 21.0
    assert len(PAGE.findall(b64decode(page.driver.print_page(a4)))) == 1


def test_a_program_of_the_hubs_page_drives_its_robot_is_kept_there_and_the_class_sheet_lists_it(page, robots, tmp_path):
    page.open(f"{robots.address}program", OTHER)
    page.resize(*LYING)
    page.element("file").send_keys(as_file(tmp_path, program(drive(0.5, 3))))
    page.wait_for(lambda: not page.value("file"), "the file to be read")
    page.wait_for(lambda: page.text("kept") == "Kept", "the program to be kept")
    page.click("#run")
    robots.wait_for(lambda: robots.wheels(OTHER) != STOPPED, f"{OTHER} to drive", within=10.0)
    assert robots.wheels(ONE) == STOPPED
    robots.wait_for(lambda: robots.wheels(OTHER) == STOPPED, "the program's end", within=10.0)
    page.click("#overview-button")
    page.wait_for_text("all-programs", OTHER)
    assert all(robot in page.text("score-table") for robot in ROBOTS)


def test_the_class_sheet_names_the_robot_whose_programs_it_lacks(page, robots):
    page.open(f"{robots.address}program", ONE)
    receive_fleet(page)
    page.click("#overview-button")
    page.wait_for_text("overview-problem", "Out of reach, so their programs are missing here: jetbot_09")


def test_a_class_of_fifteen_is_seen_at_a_glance_with_what_to_do_before_the_lesson(page):
    for screen in DESKTOP, LYING:
        page.resize(*screen, touch=screen != DESKTOP)
        receive_fleet(page)
        page.wait_for_text("to-do", "Charge before the lesson: jetbot_04, jetbot_11\nWeak supply: jetbot_04, jetbot_11")
        page.wait_for_text("to-do", "Other version: jetbot_03")
        assert page.cut("#fleet .why") == page.overlapping() == [], screen
        assert page.outside("#fleet li", "#fleet-list") == [], screen
    page.wait_for(lambda: "battery 33 %" in page.text_of(f"{ROW.format('jetbot_04')} .facts"), "its battery")
    page.choose("jetbot_09")
    page.wait_for_text("status", "out of reach. Driven from here, it stops by itself")
    assert level(page, "jetbot_09") == "away" and page.text("left-value") == "–"


def test_the_health_of_a_robot_is_shown_where_it_needs_something_and_else_when_asked_for(page):
    page.resize(*PHONE)
    receive_fleet(page)
    page.choose("jetbot_04")
    page.wait_for_text("health", "Charge it before the lesson.")
    assert "Temperature" not in page.text("health") and page.text("show-health") == "33 %"
    page.choose("jetbot_01")
    page.wait_for(lambda: not page.text("health"), "nothing to do")
    page.tab_to("show-health")
    page.tap("Enter")
    page.wait_for_text("health", "Temperature: 52")
    link = page.element("own-page")
    assert link.text == "Page of jetbot_01" and link.get_attribute("href") == "http://192.168.1.10:8080/"
    assert link.get_attribute("rel") == "noopener"
    page.tap("Enter")
    page.wait_for(lambda: not page.text("health"), "it to be closed")
