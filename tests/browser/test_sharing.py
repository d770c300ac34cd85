"""One person drives a robot; the others watch, and see who drives."""

from .conftest import ROBOT


def not_backward(left, right):
    return left >= 0 and right >= 0


def test_a_second_person_is_refused_and_sees_who_drives(page, pupil, world):
    page.rename("Ada")
    world.drive(page, ROBOT)
    pupil.wait_for_text("driver", "Ada drives it")
    pupil.touch(forward=-1.0)
    pupil.wait_for_text("notice", "Ada drives")
    world.stay(not_backward, ROBOT)
    pupil.lift()
    world.stay(not_backward, ROBOT)


def test_a_robot_is_free_as_soon_as_its_driver_leaves(page, pupil, world):
    page.new_tab(f"{world.address}icon.svg")
    page.show_tab(0)
    world.drive(page, ROBOT)
    with world.stops(ROBOT, what="the page's end"):
        page.driver.close()
    page.show_tab(0)
    world.drive(pupil, ROBOT)


def test_a_teacher_takes_a_robot_from_a_pupil(page, pupil, world):
    pupil.rename("Ben")
    world.drive(pupil, ROBOT)
    page.wait_for_text("driver", "Ben drives it")
    with world.stops(ROBOT, what="the teacher's click on Take over", page=page):
        page.element("take").click()
    pupil.move(0.9, 0.1)
    world.stay_stopped(ROBOT)
    world.drive(page, ROBOT)


def test_a_pupil_has_neither_fleet_nor_codes_nor_others_robots(pupil):
    for name in "fleet", "show-fleet", "show-codes", "take", "reset":
        assert not pupil.element(name).is_displayed(), name


def test_a_name_is_shown_as_it_was_typed(page, pupil, world):
    page.rename("<b>Eve</b> & Ömer +1")
    world.drive(page, ROBOT)
    pupil.wait_for(lambda: pupil.text("driver") == "<b>Eve</b> & Ömer +1 drives it", "the name")
    assert page.element("name").get_attribute("value") == "<b>Eve</b> & Ömer +1"
    assert not pupil.run("return document.querySelectorAll('b').length")
