"""A hub's page does at each robot what a page of its own would do there."""

import json

import pytest

from cockpit_server import WITHIN
from jetbot.wait import wait_until

pytest_plugins = ["hub_world"]  # its fixtures

ID = "0123456789abcdef"
ADA, BOB = "/ada", "/bob"
DRIVE = {"type": "drive", "robot": ADA, "forward": 1, "left": 0}


@pytest.fixture
def robots(make_robot):
    return {name: make_robot(name) for name in ("ada", "bob")}


@pytest.fixture
def hub(robots, make_hub):
    return make_hub(robots, connected=2)


@pytest.fixture
def page(hub, open_page):
    return open_page(hub)


def test_a_stop_of_all_is_confirmed_by_each_and_nobody_drives_until_its_release_and_the_finger_has_lifted(robots, page):
    page.send({"type": "stop"})
    said = page.receive_until(lambda said: said["type"] == "state" and said["emergency"] and not said["unconfirmed"])
    assert set(said["robots"]) == {ADA, BOB}
    page.send(DRIVE)
    assert page.receive("lift")["code"] == "all_stopped"
    page.send({"type": "release"})
    page.receive_until(lambda said: said["type"] == "state" and not said["emergency"])
    assert not any(robot.control.stopped for robot in robots.values())
    page.send(DRIVE)
    assert page.receive("lift")["code"] == "let_go" and ("drive", ADA) not in robots["ada"].done
    page.send({**DRIVE, "forward": 0})
    page.send(DRIVE)
    assert wait_until(lambda: robots["ada"].control.handled[-1][1].moves, WITHIN)
    assert ("drive", ADA) not in robots["bob"].done


def test_a_closed_page_leaves_no_socket_at_a_robot(robots, page):
    page.close()
    assert wait_until(lambda: len(robots["ada"].control.left) == 1 and len(robots["bob"].control.left) == 1, WITHIN)


def test_programs_are_kept_at_the_robot_and_listed_for_all(robots, page, hub):
    large = json.dumps({"blocks": 60000 * "x"})
    save = {"do": "save", "robot": ADA, "id": ID, "version": 0, "name": "Square", "program": large}
    status, saved = hub.work(**save)
    assert (status, saved["version"], saved["class"]) == (200, 1, hub.fleet.id)
    assert hub.work(**save, **{"class": hub.fleet.id})[0] == 200
    assert hub.work(**{**save, "version": 1, "name": "B", "class": "f" * 16})[1]["code"] == "other_class"
    assert [row["name"] for row in hub.work(do="list", robot=None)[1]["programs"]] == ["Square"]
    assert hub.work(do="open", robot=ADA, id=ID)[1]["program"] == large
    assert hub.work(do="delete", robot=ADA, id=ID)[1]["deleted"]
    assert not hub.work(do="restore", robot=ADA, id=ID)[1]["deleted"]
    assert robots["ada"].classroom.programs.rows(None) and not robots["bob"].classroom.programs.rows(None)


def test_a_robot_that_is_gone_is_named_and_keeps_nobody_waiting(robots, page, hub):
    robots["ada"].server.end()
    said = page.receive_until(lambda said: said["type"] == "state" and not said["robots"][ADA]["answers"])
    assert said["robots"][BOB]["answers"]
    assert hub.work(do="list", robot=ADA)[1]["code"] == "no_answer"
    page.send({"type": "stop"})
    said = page.receive_until(lambda said: said["type"] == "state" and said["unconfirmed"] == [ADA])
    assert robots["bob"].control.stopped


def test_a_page_draws_the_curves_of_the_robot_that_it_asked_for_last_and_of_no_other(robots, page):
    for robot, volts in (ADA, 12.1), (BOB, 11.4):
        page.send({"type": "curves", "robot": robot, "eyes": False})
        assert page.receive_until(lambda said, robot=robot: said["type"] == "curves" and said["robot"] == robot)
        for name, each in robots.items():
            each.control.recording.add("battery", 1.0, volts if f"/{name}" == robot else 0.0)
        assert page.receive("curves")["battery"] == [[1.0, volts]]
    page.send({"type": "curves", "robot": None, "eyes": False})
    viewers = [viewer for robot in robots.values() for viewer in robot.server._pages._viewers.values()]
    assert wait_until(lambda: not any(viewer.curves.robot for viewer in viewers), WITHIN)


def test_a_robot_has_its_address_and_its_delay(robots, hub):
    page = hub.page()
    rows = page.receive("robots")["robots"]
    assert [row["address"] for row in rows] == [f"http://{robots[name].address}/" for name in ("ada", "bob")]
    said = page.receive_until(lambda said: said["type"] == "state" and said["robots"][ADA]["link"] is not None)
    assert 0 <= said["robots"][ADA]["link"] < 1000 * WITHIN
    page.close()
