"""The hub dies, freezes, sleeps, or there are two: robots that it drives stop, all others drive on."""

import time

import pytest
from lesson import STOP_BOUND, measured
from network import CUT
from school import BACK, CLASS, Hub

from jetbot.wait import wait_until
from jetbot_cockpit.remote.fleet import Fleet

FROZEN = 5.0  # s
STOP_ALL = 0.1 + 0.15  # s, and what a busy computer takes


@pytest.mark.short
def test_stop_reaches_all_robots_at_once_and_one_that_is_cut_off_when_it_comes_back(lesson):
    first, *others = lesson.school.robots
    first.host.spoil(CUT, CUT)
    time.sleep(STOP_BOUND)
    stopped_at = time.monotonic()
    lesson.teacher.send(type="stop")
    for robot in others:
        lesson.stops(robot, stopped_at, "STOP", STOP_ALL)
    lesson.teacher.wait(lambda: lesson.teacher.state["unconfirmed"] == [f"/{first.name}"], 5.0, "its name")
    first.host.spoil()
    lesson.teacher.wait(lambda: len(lesson.school.stopped(lesson.teacher)) == len(lesson.school.robots), 5.0, "all")
    assert lesson.teacher.state["unconfirmed"] == []
    for page in lesson.pages.values():
        page.let_go()
    for robot in lesson.school.robots:
        lesson.pages[robot.name].press(robot.name, lets_go=False)
    time.sleep(0.5)
    assert not any(lesson.wheels.turned(robot.name, stopped_at + STOP_ALL) for robot in lesson.school.robots)
    lesson.teacher.send(type="release")
    lesson.teacher.wait(lambda: not lesson.school.stopped(lesson.teacher), 5.0, "the release")
    for robot in lesson.school.robots:
        lesson.pages[robot.name].let_go()
        lesson.press(robot)


@pytest.mark.short
def test_a_killed_hub_stops_what_it_drives_and_nothing_else(lesson):
    hub = lesson.school.hub
    lesson.others_notice_nothing("hub killed, a tablet", hub.kill, lesson.third)
    killed_at = time.monotonic()
    for robot in lesson.first, lesson.second:
        lesson.stops(robot, killed_at, "hub killed")
    hub.start()
    lesson.is_back("hub started again", lesson.first, lesson.second)
    lesson.press(lesson.first)


@pytest.mark.parametrize("link", ["up", "down"], ids=["frozen", "its lid is closed"])
def test_a_hub_that_goes_on_sends_no_late_command(lesson, link):
    hub, frozen_at = lesson.school.hub, time.monotonic()
    for robot in lesson.first, lesson.second:
        lesson.pages[robot.name].lets_go = False
    hub.host.set_link(link)
    hub.freeze()
    for robot in lesson.first, lesson.second:
        lesson.stops(robot, frozen_at, "hub frozen")
    time.sleep(FROZEN)
    assert all(lesson.wheels.turn(robot.name) for robot in lesson.school.robots[2:]), "the tablets drive on"
    hub.thaw()
    hub.host.set_link("up")
    lesson.is_back("hub goes on", lesson.first, lesson.second)
    assert not wait_until(lambda: any(lesson.wheels.turned(robot.name, frozen_at + STOP_BOUND)
                                      for robot in (lesson.first, lesson.second)), 2.0), "a late command"
    for robot in lesson.first, lesson.second:
        lesson.pages[robot.name].let_go()
    lesson.press(lesson.first)


@pytest.mark.short
def test_a_finger_that_stays_on_the_pad_drives_nothing_when_the_link_is_back(lesson):
    robot, page = lesson.first, lesson.pages[lesson.first.name]
    page.lets_go = False
    robot.host.spoil(CUT, CUT)
    lesson.stops(robot, time.monotonic(), "cut, with the finger on the pad")
    lesson.teacher.wait(lambda: not lesson.teacher.robot(robot.name)["answers"], 5.0, "the page to say so")
    robot.host.spoil()
    lesson.is_back("cut, with the finger on the pad", robot)
    assert not wait_until(lambda: lesson.wheels.turn(robot.name), BACK), "it drives by itself"
    page.let_go()
    lesson.press(robot)


def test_of_two_hubs_one_stops_and_the_other_releases(lesson, tmp_path):
    school = lesson.school
    other = Fleet(str(tmp_path), CLASS)
    other.key = school.fleet.key
    other.save(school.fleet.robots)
    hub = Hub(school.computers["second_laptop"], tmp_path)
    page = hub.page()
    try:
        page.wait(lambda: school.answer(page), 5.0, "all robots at the other hub")
        driver = page.robot(lesson.first.name)["driver"]
        assert driver and driver["id"] == 0 and driver["name"].startswith("teacher")
        stopped_at = time.monotonic()
        lesson.teacher.send(type="stop")
        for robot in school.robots:
            lesson.stops(robot, stopped_at, "STOP beside another hub", STOP_ALL)
        page.wait(lambda: len(school.stopped(page)) == len(school.robots), 2.0, "the other hub to show it")
        page.send(type="release")
        measured("release by the other hub", lesson.teacher.wait(
            lambda: not lesson.teacher.state["emergency"] and not school.stopped(lesson.teacher), 5.0, "the release"))
        time.sleep(1.0)
        assert not school.stopped(page), "the first hub stops again what the other has released"
    finally:
        page.close()
        hub.close()
