"""One person drives a robot; the others watch, and see who drives. A teacher may do more."""

import re
from base64 import b64decode

import pytest

from harness import START_TIMEOUT
from jetbot.fake.motors import STOPPED

from .conftest import OTHER_ROBOT, ROBOT
from .messages import codes_of

NAME = "<b>Eve</b> & Ömer +1"


def not_backward(left, right):
    return left >= 0 and right >= 0


def test_a_second_person_is_refused_and_sees_who_drives(page, pupil, world):
    page.type("name", NAME)
    world.drive(page, ROBOT)
    page.wait_for_text("status", "You drive it")
    pupil.wait_for_text("driver", f"{NAME} drives it")
    pupil.touch(forward=-1.0)
    pupil.wait_for_text("notice", f"{NAME} drives")
    assert not pupil.has("b"), "a name is text"
    world.stay(not_backward, ROBOT)
    pupil.lift()
    world.stay(not_backward, ROBOT)


def test_a_teacher_takes_a_robot_from_a_pupil_who_is_told(page, pupil, world):
    page.type("name", "Ada")
    pupil.type("name", "Ben")
    world.drive(pupil, ROBOT)
    page.wait_for_text("driver", "Ben drives it")
    with world.stops(ROBOT, what="the teacher's click on Take over"):
        page.click("#take")
    pupil.wait_for_text("notice", f"Ada has taken {ROBOT}")
    pupil.move(0.9, 0.1)
    world.stay_stopped(ROBOT)
    pupil.lift()
    world.drive(page, ROBOT)
    page.lift()
    page.click("#go-on")
    pupil.wait_for_text("driver", "Free to drive")
    world.drive(pupil, ROBOT)


@pytest.fixture
def scenario(page, world):
    """A program that drives ROBOT, which no teacher holds any more."""
    page.run("document.getElementById('all-go-on').click()")
    topic = f"/{ROBOT}/cmd_vel"
    program = world.start("rostopic", "pub", "-r", "10", topic, "geometry_msgs/Twist", "{linear: {x: 0.3}}")
    world.wait_for(lambda: drives(world), START_TIMEOUT, "the program to drive")
    yield
    world.kill(program)


def drives(world):
    return world.wheels(ROBOT)[0] == pytest.approx(0.3, abs=0.01)


def test_a_program_drives_on_after_a_countdown_but_after_a_teachers_take_only_once_that_is_allowed(
        page, pupil, world, scenario):
    def take_during_countdown():
        world.drive(pupil, ROBOT, -1.0, wanted=lambda left, right: left == right < 0)
        pupil.lift()
        for each in page, pupil:
            each.wait_for_text("driver", "The program drives on in ")
        page.click("#take")
        for each in page, pupil:
            each.wait_for_text("driver", "Pupils and programs wait until a teacher presses Go on")
    world.undisturbed(pupil, take_during_countdown)
    world.stay_stopped(ROBOT)
    page.click("#go-on")
    world.wait_for(lambda: drives(world), 10.0, "the program to drive on")


def stand(world):
    world.wait_for(lambda: world.wheels(ROBOT) == STOPPED, START_TIMEOUT, "the program to wait")


def test_after_a_teachers_stop_and_release_a_program_that_drove_waits_until_go_on(page, world, scenario):
    page.click("#stop")
    stand(world)
    page.wait_for_text("status", "emergency stop")
    page.click("#release")
    page.wait_for_text("driver", "The program waits until a teacher presses Go on")
    world.stay_stopped(ROBOT)
    page.click("#show-fleet")
    page.wait_for_text("fleet-list", "The program waits")
    page.click("#all-go-on")
    page.click("#show-fleet")
    world.wait_for(lambda: drives(world), START_TIMEOUT, "the program to drive on")


def test_what_a_teacher_takes_waits_though_the_teachers_page_is_closed_and_every_page_says_why(
        page, pupil, world, scenario):
    reason = f"Your teacher has taken {ROBOT}. Wait until a teacher presses Go on."
    page.click("#take")
    stand(world)
    page.open(world.address, ROBOT)
    pupil.wait_for_text("status", reason)
    pupil.touch()
    pupil.wait_for_text("notice", reason)
    pupil.lift()
    pupil.open(world.codes()["pupil"].replace("#", "program#"), ROBOT)
    pupil.wait_for_text("status", reason)
    pupil.set("examples", "One metre")
    pupil.click("#run")
    pupil.wait_for_text("outcome", f"Your teacher took {ROBOT}.")
    world.stay_stopped(ROBOT)
    page.wait_for(lambda: page.element("go-on").is_displayed(), "Go on")
    page.click("#go-on")
    world.wait_for(lambda: drives(world), START_TIMEOUT, "the program to drive on")


def test_a_pupil_has_neither_fleet_nor_codes_nor_others_robots(pupil):
    for name in "fleet", "show-fleet", "show-codes", "take", "go-on", "reset":
        assert not pupil.element(name).is_displayed(), name


def test_codes_are_shown_when_asked_for_and_15_fit_on_a_sheet_of_paper_with_a_line_for_each_name(page, world):
    codes = {role: url.partition("#")[2] for role, url in world.codes().items()}
    page.click("#show-codes")
    page.wait_for_text("codes", codes["pupil"])
    assert codes["teacher"] not in page.text("codes")
    page.click("#show-teacher")
    page.wait_for_text("codes", codes["teacher"])
    page.receive(codes_of(15))
    sheet = page.driver.execute_cdp_cmd("Page.printToPDF", {"paperWidth": 8.27, "paperHeight": 11.69})
    assert len(re.findall(rb"/Type\s*/Page\b", b64decode(sheet["data"]))) == 1
    page.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    try:
        assert page.text("codes-list").count("Name:") == 15
    finally:
        page.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})


@pytest.fixture
def codes(page):
    """The teacher's page with the codes of two robots; their pupils have no names afterwards."""
    page.click("#show-codes")
    page.wait_for(lambda: page.has("#codes-list li"), "the codes")
    page.receive(codes_of(2))
    page.run("""const send = socket.send.bind(socket);
        window.asked = [];
        socket.send = (text) => { asked.push(JSON.parse(text)); send(text); }""")
    yield page
    page.send({"type": "pupil", "robot": f"/{ROBOT}", "name": ""})


def asked(page, kind):
    """Return the messages of this type that the page has sent."""
    return page.run("return asked.filter(({ type }) => type === arguments[0])", kind)


def test_a_pupil_sees_the_name_that_a_teacher_has_typed_beside_the_code(codes, pupil, world):
    pupil.open(world.codes()["pupil"].replace("#", "program#"), ROBOT)
    codes.driver.find_element("css selector", "#codes-list input").send_keys(f"{NAME}\n")
    pupil.wait_for(lambda: pupil.robots()[f"/{ROBOT}"] == f"{ROBOT}, {NAME}", "the name")
    assert not pupil.has("b") and codes.run("return document.activeElement.dataset.robot") == f"/{OTHER_ROBOT}"
    codes.click("#close-codes")
    codes.click("#show-fleet")
    codes.wait_for_text("fleet-list", f"{ROBOT}, {NAME}")


def test_one_code_is_shown_large_until_escape_which_stops_nothing_then(codes):
    for width, height in (1920, 1080), (1024, 768), (844, 390), (390, 844):
        codes.resize(width, height)
        codes.click("#codes-list .enlarge")
        assert ROBOT in codes.text("codes-list") and OTHER_ROBOT not in codes.text("codes-list")
        assert codes.fits("stop", "new-code", "close-codes") and not codes.outside("#codes-list .code", "#codes")
        codes.tap("Escape")
        assert OTHER_ROBOT in codes.text("codes-list") and codes.fits("show-codes")
        assert codes.run("return document.activeElement.dataset.label") == ROBOT, "the keyboard's focus is where it was"
    assert not asked(codes, "stop")
    codes.tap("Escape")
    assert asked(codes, "stop")


def test_a_new_code_needs_a_second_press(codes):
    codes.click("#codes-list .enlarge")
    codes.click("#new-code")
    codes.wait_for_text("new-code", "End the old code?")
    assert not asked(codes, "new_code")
    codes.click("#new-code")
    assert asked(codes, "new_code") == [{"type": "new_code", "robot": f"/{ROBOT}"}]
