"""Which robots come and go, in the terminal."""

from jetbot_cockpit_server.attendance import NO_ROBOT, NO_ROBOT_AFTER, Attendance
from jetbot_cockpit_server.view import Robot


def robots(*names, silent=()):
    return {name: Robot(name, answers=name not in silent) for name in names}


def test_robots_that_come_go_and_hang_are_named_once():
    attendance = Attendance(0.0)
    assert attendance.update(robots("/red", "/blue"), 1.0) == ["on the page: red and blue"]
    assert attendance.update(robots("/red", "/blue"), 2.0) == []
    assert attendance.update(robots("/red", "/blue", silent=["/blue"]), 3.0) == ["not answering: blue"]
    assert attendance.update(robots("/red", "/blue"), 4.0) == ["answering again: blue"]
    assert attendance.update(robots("/blue"), 5.0) == ["ended: red"]


def test_no_robot_at_all_is_reported_once_with_the_command_that_starts_one():
    attendance = Attendance(100.0)
    assert attendance.update({}, 100.0) == []
    assert attendance.update({}, 100.0 + NO_ROBOT_AFTER) == [NO_ROBOT]
    assert attendance.update({}, 200.0) == []


def test_the_lack_of_robots_is_not_reported_when_there_was_one():
    attendance = Attendance(0.0)
    attendance.update(robots("/red"), 1.0)
    assert attendance.update({}, 100.0) == ["ended: red"]
