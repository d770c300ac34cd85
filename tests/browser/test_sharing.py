"""One person drives a robot; the others watch, and see who drives."""

from .conftest import ROBOT


def drive(page, world):
    page.touch()
    world.wait_for_motion(ROBOT)


def test_a_second_person_is_refused_and_sees_who_drives(page, pupil, world):
    page.rename("Ada")
    drive(page, world)
    pupil.wait_for_text("driver", "Ada")
    pupil.touch(forward=-1.0)
    pupil.wait_for_text("notice", "Ada")
    world.stays(ROBOT, lambda left, right: left > 0 and right > 0)
    pupil.lift()
    world.stays(ROBOT, lambda left, right: left > 0 and right > 0)


def test_a_robot_is_free_after_five_seconds_of_silence(page, pupil, world):
    drive(page, world)
    page.lift()
    world.wait_for_stop(ROBOT)
    pupil.touch()
    world.stays_stopped(ROBOT, 3.0)
    pupil.lift()
    pupil.wait_for(lambda: pupil.touch() or world.moves(ROBOT) or pupil.lift(), "the robot to be free", 5.0)
    pupil.lift()


def test_a_robot_is_free_as_soon_as_its_driver_leaves(page, pupil, world):
    drive(page, world)
    page.leave()
    world.wait_for_stop(ROBOT)
    drive(pupil, world)
    pupil.lift()


def test_a_teacher_takes_a_robot_from_a_pupil(page, pupil, world):
    pupil.rename("Ben")
    drive(pupil, world)
    page.wait_for_text("driver", "Ben")
    page.element("take").click()
    world.wait_for_stop(ROBOT)
    pupil.move(0.9, 0.1)
    world.stays_stopped(ROBOT)
    drive(page, world)
    pupil.lift()


def test_a_pupil_has_no_fleet_to_command(pupil):
    assert not pupil.element("fleet").is_displayed()


def test_a_name_with_html_stays_text(page, pupil, world):
    page.rename("<b>Eve</b>")
    drive(page, world)
    pupil.wait_for_text("driver", "<b>Eve</b>")
    assert not pupil.run("return document.querySelectorAll('b').length")
