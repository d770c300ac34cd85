"""The page of a class of real robots, served by a hub: each robot has a ROS master and a cockpit of its own."""

import re
from base64 import b64decode

import pytest

from jetbot.fake.motors import STOPPED
from jetbot.wait import wait_until

from .messages import codes_of, numbered, receive_fleet
from .programs import as_file, drive, program
from .real_class import RealClass
from .screens import DESKTOP
from .test_page import LISTEN

ONE, OTHER = ROBOTS = "jetbot_01", "jetbot_02"
PHONE, LYING = (360, 640), (1024, 768)  # px
BACK_WITHIN = 60.0  # s until a robot's programs have started
CARDS = """return [...document.querySelectorAll("#codes-list li")].map((card) => ["h3", ".address", ".code"].map(
  (part) => card.querySelector(part).textContent))"""
TO_DO = "Charge before the lesson: jetbot_04, jetbot_11\nWeak supply: jetbot_04, jetbot_11", "Other version: jetbot_03"
ROW = "#fleet li[data-robot='/{}']"


@pytest.fixture(scope="module")
def robots(tmp_path_factory):
    """Two real robots and a hub."""
    robots = RealClass(tmp_path_factory.mktemp("class"), *ROBOTS)
    yield robots
    robots.close()


@pytest.fixture(scope="module")
def hub_page(robots, browsers):
    page = browsers(1)
    page.open(robots.address)
    page.wait_for(lambda: all(is_here(page, robot) for robot in ROBOTS), "all robots", within=BACK_WITHIN)
    page.errors()
    yield page
    page.leave()
    assert page.errors() == []


@pytest.fixture
def page(hub_page, robots):
    """The teacher's page at the hub, on a desktop."""
    hub_page.open(robots.address, ONE)
    hub_page.send({"type": "release", "robot": None})
    hub_page.resize(*DESKTOP, touch=False)
    return hub_page


@pytest.fixture(scope="module")
def fleet(hub_page, robots):
    """That page with fifteen robots, of which only it knows."""
    hub_page.open(robots.address)
    receive_fleet(hub_page)
    return hub_page


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
        assert [each for each in ROBOTS if robots.wheels(each) != STOPPED] == [robot]
        page.wait_for_text("status", "You drive it")
        page.driver.get("about:blank")
        robots.wait_for(lambda robot=robot: robots.wheels(robot) == STOPPED, f"{robot} to stop", within=2.0)
        page.open(robots.address, ONE)
        page.resize(*LYING)
        page.lift()


def test_stop_names_the_robot_that_was_killed_until_it_is_back_and_stopped(page, robots):
    page.run(LISTEN)
    robots.kill_robot(OTHER)
    page.wait_for(lambda: not is_here(page, OTHER), "the loss of the robot")
    page.click("#stop")
    page.wait_for_text("unconfirmed", f"Stopped: 1 of 2. Not confirmed: {OTHER}. Use their own switches.")
    assert level(page, ONE) == "stopped"
    assert level(page, OTHER) in ("away", "warning"), "nobody knows whether it is stopped"
    assert any(OTHER in text for text in page.run("return said")), "a screen reader says it"
    assert page.run("return document.getElementById('unconfirmed').role") == "alert"
    robots.start_robot(OTHER)
    page.wait_for(lambda: not page.text("unconfirmed"), f"{OTHER} to be back", within=BACK_WITHIN)
    page.wait_for(lambda: level(page, OTHER) == "stopped", f"{OTHER} to be stopped")
    page.choose(OTHER)
    page.wait_for(lambda: page.touch() or wait_until(  # again, as the pad may just have moved
        lambda: "must be released first" in page.text("notice"), 2.0), "the refusal")
    assert robots.wheels(OTHER) == STOPPED
    page.lift()
    page.click("#release")
    page.wait_for(lambda: level(page, OTHER) != "stopped", "the release")
    hold(page, robots, OTHER)
    page.lift()


def test_the_cards_open_by_themselves_with_each_robots_own_address(page, robots):
    page.open(f"{robots.address}?codes")
    page.wait_for(lambda: len(page.run(CARDS)) == len(ROBOTS), "a card of each robot")
    cards = page.run(CARDS)
    assert [card[0] for card in cards] == list(ROBOTS)
    assert [card[1].rstrip("/").rpartition(":")[2] for card in cards] == [str(robots.port_of(each)) for each in ROBOTS]
    assert all(card[2] for card in cards) and page.driver.current_url == robots.address


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
    page.tap("Escape")
    receive_fleet(page)
    page.click("#overview-button")
    page.wait_for_text("overview-problem", "Out of reach, so their programs are missing here: jetbot_09")


def test_a_class_of_fifteen_is_seen_at_a_glance_with_what_to_do_before_the_lesson(fleet):
    for screen in DESKTOP, LYING:
        fleet.resize(*screen, touch=screen != DESKTOP)
        for task in TO_DO:
            fleet.wait_for_text("to-do", task)
        assert fleet.cut("#fleet .why") == fleet.overlapping() == [], screen
        assert fleet.outside("#fleet li", "#fleet-list") == [], screen
    fleet.wait_for(lambda: "battery 33 %" in fleet.text_of(f"{ROW.format('jetbot_04')} .facts"), "its battery")
    fleet.choose("jetbot_09")
    fleet.wait_for_text("status", "out of reach. Driven from here, it stops by itself")
    assert level(fleet, "jetbot_09") == "away" and fleet.text("left-value") == "–"


def test_the_health_of_a_robot_is_shown_where_it_needs_something_and_else_when_asked_for(fleet):
    fleet.resize(*PHONE)
    fleet.choose("jetbot_04")
    fleet.wait_for_text("health", "Charge it before the lesson.")
    assert "Temperature" not in fleet.text("health") and fleet.text("show-health") == "33 %"
    fleet.choose("jetbot_01")
    fleet.wait_for(lambda: not fleet.text("health"), "nothing to do")
    fleet.tab_to("show-health")
    fleet.tap("Enter")
    fleet.wait_for_text("health", "Temperature: 52")
    link = fleet.element("own-page")
    assert link.text == "Page of jetbot_01" and link.get_attribute("href") == "http://192.168.1.10:8080/"
    assert link.get_attribute("rel") == "noopener"
    fleet.tap("Enter")
    fleet.wait_for(lambda: not fleet.text("health"), "it to be closed")


def test_the_cards_of_fifteen_robots_are_one_sheet_of_paper_with_a_line_for_each_name(fleet):
    fleet.resize(*DESKTOP, touch=False)
    fleet.click("#show-codes")
    fleet.receive(codes_of(15))
    assert [card[0] for card in fleet.run(CARDS)] == numbered(15)
    assert len({card[1] for card in fleet.run(CARDS)}) == 15
    sheet = fleet.driver.execute_cdp_cmd("Page.printToPDF", {"paperWidth": 8.27, "paperHeight": 11.69})
    assert len(re.findall(rb"/Type\s*/Page\b", b64decode(sheet["data"]))) == 1
    fleet.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    assert fleet.text("codes-list").count("Name:") == 15
    fleet.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
