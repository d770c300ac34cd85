"""Who stops, takes and puts back which robot, with robots and a clock that are turned by hand."""

import pytest
from cockpit_control import ADA, BOB, OWN, STOPPED, TEACHER, FakeRobots

from jetbot_cockpit_server.protocol import Release, Reset, Stop, Take

pytest_plugins = ["cockpit_control"]  # its fixtures


def test_a_teacher_takes_a_robot_and_the_finger_must_lift(driven):
    assert driven.do(TEACHER, Take("/red")) is None
    assert (driven.drives(), driven.driver()["id"]) == (STOPPED, TEACHER.id)
    driven.control.leave(TEACHER.id)
    driven.must_lift(ADA)


def test_a_finger_that_was_up_when_the_teacher_took_drives_at_once_later(driven):
    driven.lift(ADA)
    driven.do(TEACHER, Take("/red"))
    driven.control.leave(TEACHER.id)
    assert driven.push(ADA) is None


def test_a_pupil_takes_and_puts_back_nothing(driven):
    assert driven.do(BOB, Take("/red"))["type"] == "notice"
    assert driven.do(BOB, Reset())["type"] == "notice"
    assert (driven.driver()["id"], driven.robots.were_reset) == (ADA.id, [])


def test_a_pupil_with_a_robot_drives_and_stops_that_one_only(cockpit):
    assert cockpit.push(OWN, "/red") == {
        "type": "lift", "robot": "/red", "text": "With your code, you can drive only blue."}
    assert cockpit.do(OWN, Stop("/red"))["type"] == "notice"
    assert cockpit.do(OWN, Release("/red"))["type"] == "notice"
    assert cockpit.do(OWN, Stop("/blue")) is None
    assert [robot.stopped for robot in cockpit.robots.now.robots.values()] == [False, True]
    assert cockpit.do(OWN, Release("/blue")) is None
    cockpit.lift(OWN, "/blue")
    assert cockpit.push(OWN, "/blue") is None


@pytest.mark.parametrize("robot", [None, "/red"])
def test_a_stop_ends_the_lease_and_the_finger_must_lift_after_its_release(driven, robot):
    driven.do(TEACHER, Stop(robot))
    assert (driven.drives(), driven.driver()) == (STOPPED, None)
    assert "top" in driven.push(ADA, seconds=1)["text"]
    driven.do(TEACHER, Release(robot))
    driven.must_lift(ADA)


def test_anybody_stops_all_and_releases_that(driven):
    assert driven.do(BOB, Stop()) is None
    assert driven.control.state()["emergency"]
    assert driven.do(ADA, Release()) is None
    assert not driven.control.state()["emergency"]


def test_a_stop_by_a_teacher_is_released_by_a_teacher(driven):
    driven.do(TEACHER, Stop())
    driven.do(ADA, Stop())
    driven.wait(1)
    assert driven.do(ADA, Release())["type"] == "notice"
    assert driven.robots.now.emergency
    assert driven.do(TEACHER, Release()) is None
    driven.do(ADA, Stop())
    assert driven.do(ADA, Release()) is None


def test_a_stop_by_a_teacher_that_ros_has_released_is_forgotten(driven):
    driven.do(TEACHER, Stop())
    driven.robots.stop(None, False)
    driven.wait(0.05)
    driven.do(ADA, Stop())
    assert driven.do(ADA, Release()) is None


def change(fake, **fields):
    fake.now = fake.now._replace(**fields)


@pytest.mark.parametrize("break_it, repair_it", [
    (lambda robots: change(robots, emergency=True), lambda robots: change(robots, emergency=False)),
    (lambda robots: change(robots, master=False), lambda robots: change(robots, master=True)),
    (lambda robots: change(robots, robots={}), lambda robots: change(robots, robots=FakeRobots().now.robots)),
    (lambda robots: robots.change("/red", answers=False), lambda robots: robots.change("/red", answers=True)),
], ids=["emergency stop", "master", "robot gone", "robot does not answer"])
def test_what_comes_back_while_a_finger_is_down_does_not_jump_off(driven, break_it, repair_it):
    break_it(driven.robots)
    driven.wait(0.05)
    assert driven.drives() == STOPPED
    repair_it(driven.robots)
    driven.must_lift(ADA)


def test_a_teacher_puts_back_simulated_robots(cockpit):
    cockpit.robots.change("/blue", simulated=False)
    cockpit.wait(0.05)
    assert cockpit.do(TEACHER, Reset()) is None
    assert cockpit.robots.were_reset == ["/red"]
    assert cockpit.do(TEACHER, Reset("/blue"))["type"] == "notice"
    assert cockpit.do(TEACHER, Reset("/red"))["text"] == "red has not answered yet."


def test_a_robot_that_was_put_back_starts_its_trail_again(cockpit):
    cockpit.robots.change("/red", pose=(1.0, 0.0, 0.0))
    assert cockpit.wait(0.05) == []
    cockpit.robots.change("/red", pose=(0.0, 0.0, 0.0))
    assert cockpit.wait(0.05) == [{"type": "trail", "robot": "/red", "points": []}]


def test_a_robot_that_was_put_back_by_a_teacher_starts_its_trail_again_however_near_its_start_is(cockpit):
    cockpit.robots.change("/red", pose=(0.1, 0.0, 0.0))
    cockpit.wait(0.05)
    cockpit.do(TEACHER, Reset("/red"))
    cockpit.robots.change("/red", pose=(0.0, 0.0, 0.0))
    assert [message for _ in range(12) for message in cockpit.wait(0.05)] == [
        {"type": "trail", "robot": "/red", "points": []}]
