"""One person drives a robot; the others watch, and see who drives. A teacher may do more."""

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
    for name in "fleet", "show-fleet", "show-codes", "take", "go-on", "reset":
        assert not pupil.element(name).is_displayed(), f"a pupil has #{name}"
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


def test_a_program_that_drives_waits_for_people_who_are_all_told_why(page, pupil, world):
    page.run("document.getElementById('all-go-on').click()")  # no teacher holds ROBOT any more
    topic = f"/{ROBOT}/cmd_vel"
    program = world.start("rostopic", "pub", "-r", "10", topic, "geometry_msgs/Twist", "{linear: {x: 0.3}}")
    drives_on(world)
    driven_by_a_pupil(page, pupil, world)
    stopped_and_released(page, world)
    taken_by_a_teacher_who_leaves(page, pupil, world)
    world.kill(program)


def drives_on(world):
    world.wait_for(lambda: abs(world.wheels(ROBOT)[0] - 0.3) < 0.01, START_TIMEOUT, "the program to drive")


def waits(world):
    world.wait_for(lambda: world.wheels(ROBOT) == STOPPED, START_TIMEOUT, "the program to wait")


def driven_by_a_pupil(page, pupil, world):
    """After a countdown it drives on; if a teacher takes it meanwhile, once that one presses Go on."""
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
    drives_on(world)


def stopped_and_released(page, world):
    """It waits until Go on, here that of the list."""
    page.click("#stop")
    waits(world)
    page.wait_for_text("status", "emergency stop")
    page.click("#release")
    page.wait_for_text("driver", "The program waits until a teacher presses Go on")
    world.stay_stopped(ROBOT)
    page.click("#show-fleet")
    page.wait_for_text("fleet-list", "The program waits")
    page.click("#all-go-on")
    page.click("#show-fleet")
    drives_on(world)


def taken_by_a_teacher_who_leaves(page, pupil, world):
    """It waits still, as pupils and their programs do."""
    reason = f"Your teacher has taken {ROBOT}. Wait until a teacher presses Go on."
    page.click("#take")
    waits(world)
    page.open(world.address, ROBOT)
    pupil.wait_for_text("status", reason)
    pupil.touch()
    pupil.wait_for_text("notice", reason)
    pupil.lift()
    pupil.open(world.codes()["pupil"].replace("#", "program#"), ROBOT)
    pupil.set("examples", "One metre")
    pupil.wait_for(lambda: pupil.value("title") == "One metre", "the example")
    pupil.click("#run")
    pupil.wait_for_text("outcome", f"Your teacher took {ROBOT}.")
    world.stay_stopped(ROBOT)
    page.wait_for(lambda: page.element("go-on").is_displayed(), "Go on")
    page.click("#go-on")
    drives_on(world)


def test_codes_are_shown_when_asked_for(page, world):
    codes = {role: url.partition("#")[2] for role, url in world.codes().items()}
    page.click("#show-codes")
    page.wait_for_text("codes", codes["pupil"])
    assert codes["teacher"] not in page.text("codes")
    page.click("#show-teacher")
    page.wait_for_text("codes", codes["teacher"])


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


def test_one_code_is_shown_large_until_escape_which_stops_nothing_then_and_a_new_code_needs_a_second_press(codes):
    for width, height in (1920, 1080), (390, 844):
        codes.resize(width, height)
        codes.click("#codes-list .enlarge")
        assert ROBOT in codes.text("codes-list") and OTHER_ROBOT not in codes.text("codes-list")
        assert codes.fits("stop", "new-code", "close-codes") and not codes.outside("#codes-list .code", "#codes")
        codes.tap("Escape")
        assert OTHER_ROBOT in codes.text("codes-list") and codes.fits("show-codes")
        assert codes.run("return document.activeElement.dataset.label") == ROBOT, "the keyboard's focus is where it was"
    assert not asked(codes, "stop")
    codes.click("#codes-list .enlarge")
    codes.click("#new-code")
    codes.wait_for_text("new-code", "End the old code?")
    assert not asked(codes, "new_code")
    codes.click("#new-code")
    assert asked(codes, "new_code") == [{"type": "new_code", "robot": f"/{ROBOT}"}]
    codes.tap("Escape", "Escape")
    codes.wait_for(lambda: asked(codes, "stop"), "the stop by the second Escape")
