"""Who may drive which robot, with robots and a clock that are turned by hand."""

import pytest
from cockpit_control import ADA, BOB, STOPPED, TEACHER

from jetbot_cockpit_server.protocol import Name, Stop, Take
from jetbot_cockpit_server.view import Robot, program

pytest_plugins = ["cockpit_control"]  # its fixtures


def test_full_deflection_is_full_power_in_the_units_of_each_robot(cockpit):
    for geometry, (forward, turn) in {(2.0, 1.0): (1.0, 1.0), (0.1, 0.6): (0.6, 12.0), None: (1.0, 1.0)}.items():
        cockpit.robots.change("/red", geometry=geometry)
        cockpit.wait(0.05)
        cockpit.push(ADA, forward=1.0, left=0.0)
        assert cockpit.drives() == pytest.approx((forward, 0))
        cockpit.push(ADA, forward=0.0, left=1.0)
        assert cockpit.drives() == pytest.approx((0, turn))


def test_the_driver_is_shown_with_the_name_it_gives_itself(driven):
    assert driven.driver() == {"id": 1, "name": "pupil 1"}
    driven.do(ADA, Name(" Ada "))
    assert driven.driver() == {"id": 1, "name": "Ada"}
    assert driven.driver("/blue") is None


def test_release_stops_the_robot_and_keeps_it_for_five_seconds(driven):
    driven.lift(ADA)
    assert driven.drives() == STOPPED
    driven.wait(4.9)
    assert driven.driver()["id"] == ADA.id
    driven.wait(0.15)
    assert driven.driver() is None


def test_of_two_who_want_to_drive_the_second_must_lift_and_wait(driven):
    reply = driven.push(BOB, forward=-1.0)
    assert reply == {"type": "lift", "robot": "/red", "text": "pupil 1 drives red."}
    assert driven.drives() == (0.5, 0)
    assert driven.push(ADA) is None
    driven.lift(ADA)
    for _ in range(120):
        driven.wait(0.05)
        assert driven.push(BOB)["type"] == "lift"
    driven.must_lift(BOB)


def test_a_release_of_a_robot_that_another_drives_changes_nothing(driven):
    driven.lift(BOB)
    assert (driven.drives(), driven.driver()["id"]) == ((0.5, 0), ADA.id)


def test_a_finger_that_was_silent_for_too_long_must_lift(driven):
    driven.wait(0.35)
    assert driven.push(ADA)["text"].startswith("No command for 0.3 s.")
    driven.must_lift(ADA)


def test_a_hidden_tab_that_sends_once_a_second_drives_no_more(driven):
    for _ in range(10):
        driven.wait(1.0)
        driven.push(ADA)
        assert driven.drives() == STOPPED


@pytest.mark.parametrize("first", ["a check", "a command"])
def test_what_waited_in_the_sockets_while_the_cockpit_was_frozen_is_not_driven(driven, first):
    driven.time += 2.5
    if first == "a check":
        driven.control.check(driven.time)
    driven.lift(ADA)
    for _ in range(10):
        driven.time += 0.001
        assert driven.push(ADA)["type"] == "lift"
    driven.wait(0.4)
    driven.must_lift(ADA)


def test_a_finger_that_returns_after_its_lease_has_ended_must_lift(driven):
    driven.wait(5.05)
    assert driven.driver() is None
    driven.must_lift(ADA)


def test_a_switch_that_fired_does_not_hinder_the_next_driver(driven):
    driven.wait(0.35)
    driven.push(ADA)
    driven.do(TEACHER, Take("/red"))
    assert driven.push(TEACHER) is None
    assert driven.drives() == (0.5, 0)


def test_a_closed_socket_stops_its_robot_at_once_and_frees_it(driven):
    driven.control.leave(ADA.id)
    assert (driven.drives(), driven.driver()) == (STOPPED, None)
    assert driven.push(BOB) is None


def test_who_drives_another_robot_stops_the_first(driven):
    assert driven.push(ADA, "/blue") is None
    assert (driven.drives("/red"), driven.driver("/red")) == (STOPPED, None)
    assert driven.drives("/blue") == (0.5, 0)


def test_a_robot_that_there_never_was_is_not_driven(cockpit):
    assert cockpit.push(ADA, "/nobody")["text"] == "nobody has ended."
    assert cockpit.do(TEACHER, Take("/nobody"))["text"] == "nobody has ended."
    assert cockpit.do(TEACHER, Stop("/nobody"))["text"] == "nobody has ended."
    assert cockpit.drive.velocities == {}


@pytest.mark.parametrize("commanded_by, name", [
    ("/jetbot_motion_control", "jetbot_motion_control"), ("/jetbot_cockpit", ""), ("nobody yet", ""), (None, "")])
def test_the_program_that_drives_a_robot_has_its_name(commanded_by, name):
    assert program(commanded_by, "/jetbot_cockpit") == name


def test_ids_of_robots_become_short_printable_labels():
    assert [Robot(name).label for name in ("/", "/jetbot_01", "/a/b", "/\x1b[31m" + 99 * "x")] == [
        "robot", "jetbot_01", "a/b", "?[31m" + 35 * "x"]
