"""A link fails: the robot stops, no other robot notices, and all is well soon after the link is."""

import time

import pytest
from lesson import STOP_BOUND, measured
from network import CUT, GOOD, Fate

from jetbot.wait import wait_until
from jetbot_ros.contract import COCKPIT_PORT

POOR, LOSSY = Fate(loss=0.01, delay=0.03, jitter=0.02), Fate(loss=0.3)
ROUTER_RESTART = 4.0  # s
LOOPBACK = ("127.", "[::1]", "[::ffff:127.")
FAILURES = {
    "cut": (CUT, CUT, 0.0),
    "half-open, to the robot": (CUT, GOOD, 0.0),
    "half-open, from the robot": (GOOD, CUT, 1.5)}  # commands arrive until the hub misses answers, remote.link.FRESH


@pytest.mark.parametrize("failure", FAILURES)
def test_a_robot_without_a_link_stops_and_waits_for_a_finger_when_it_is_back(lesson, failure):
    to_robot, from_robot, longer = FAILURES[failure]
    robot, cut_at = lesson.first, []

    def harm():
        cut_at.append(time.monotonic())
        robot.host.spoil(to_robot, from_robot)
        lesson.stops(robot, cut_at[0], failure, STOP_BOUND + longer)
    lesson.others_notice_nothing(failure, harm, lesson.second)
    lesson.teacher.wait(lambda: not lesson.teacher.robot(robot.name)["answers"], 4.0, "the page to say so")
    robot.host.spoil()
    lesson.is_back(failure, robot)
    lesson.press(robot)


@pytest.mark.short
def test_a_poor_link_drives_and_stops(lesson):
    for robot in lesson.school.robots:
        robot.host.spoil(POOR, POOR)
    for robot in lesson.school.robots:
        if not lesson.pages[robot.name].presses:
            lesson.press(robot)
    assert measured("30 +- 20 ms, 1 % loss: p95 of commands", lesson.p95(lesson.first)) < 0.4
    stop_at = time.monotonic()
    lesson.teacher.send(type="stop")
    for robot in lesson.school.robots:
        lesson.stops(robot, stop_at, "STOP by a poor link", STOP_BOUND)


def test_a_lossy_link_stops_the_robot_rather_than_driving_it_late(lesson):
    def harm():
        lesson.first.host.spoil(LOSSY, LOSSY)
        time.sleep(2.0)
        lesson.first.host.spoil()
    lesson.others_notice_nothing("30 % loss for 2 s", harm, lesson.second)
    lesson.is_back("30 % loss for 2 s")
    lesson.pages[lesson.first.name].let_go()
    lesson.press(lesson.first)


def test_a_robot_that_is_switched_off_and_on_comes_back_and_does_not_turn(lesson):
    robot = lesson.first
    lesson.others_notice_nothing("switched off", robot.switch_off, lesson.second)
    start = time.monotonic()
    robot.reboot()
    assert wait_until(lambda: lesson.school.is_served(robot), 30.0, 0.1)
    lesson.is_back("switched on again")
    assert not lesson.wheels.turned(robot.name, start)
    lesson.press(robot)


@pytest.mark.short
def test_a_router_that_restarts_stops_all_and_all_come_back(lesson):
    hosts = [each.host for each in lesson.school.robots] + [*lesson.school.computers.values()]
    start = time.monotonic()
    for host in hosts:
        host.set_link("down")
    for robot in lesson.school.robots:
        lesson.stops(robot, time.monotonic(), "router down")
    time.sleep(max(0.0, start + ROUTER_RESTART - time.monotonic()))
    for host in hosts:
        host.set_link("up")
    lesson.is_back("router up", *lesson.school.robots)


@pytest.mark.short
def test_a_robot_listens_at_its_pages_port_and_at_no_other(school):
    for robot in school.robots:
        rows = [row.split()[3] for row in robot.host.run("ss", "-Hltn").splitlines()]
        assert {row.rpartition(":")[2] for row in rows if not row.startswith(LOOPBACK)} == {str(COCKPIT_PORT)}
        assert len(rows) > 2  # its master and nodes
