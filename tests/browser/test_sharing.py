"""One person drives a robot; the others watch, and see who drives."""

from .conftest import ROBOT


def not_backward(left, right):
    return left >= 0 and right >= 0


def test_a_second_person_is_refused_and_sees_who_drives(page, pupil, world):
    page.rename("Ada")
    world.drive(page, ROBOT)
    pupil.wait_for_text("driver", "Ada")
    pupil.touch(forward=-1.0)
    pupil.wait_for_text("notice", "Ada")
    world.stays(ROBOT, not_backward)
    pupil.lift()
    world.stays(ROBOT, not_backward)


def test_a_robot_is_free_after_five_seconds_of_silence(page, pupil, world):
    world.drive(page, ROBOT)
    page.lift()
    world.wait_for_stop(ROBOT)
    pupil.touch()
    world.stays_stopped(ROBOT, 3.0)
    world.drive(pupil, ROBOT)


def test_a_robot_is_free_as_soon_as_its_driver_leaves(page, pupil, world):
    world.drive(page, ROBOT)
    page.leave()
    world.wait_for_stop(ROBOT)
    world.drive(pupil, ROBOT)


def test_a_teacher_takes_a_robot_from_a_pupil(page, pupil, world):
    pupil.rename("Ben")
    world.drive(pupil, ROBOT)
    page.wait_for_text("driver", "Ben")
    page.element("take").click()
    world.wait_for_stop(ROBOT)
    pupil.move(0.9, 0.1)
    world.stays_stopped(ROBOT)
    world.drive(page, ROBOT)


def test_a_pupil_has_no_fleet_to_command(pupil):
    assert not pupil.element("fleet").is_displayed()


def test_a_name_with_html_stays_text(page, pupil, world):
    page.rename("<b>Eve</b>")
    world.drive(page, ROBOT)
    pupil.wait_for_text("driver", "<b>Eve</b>")
    assert not pupil.run("return document.querySelectorAll('b').length")
