"""Somebody in the network is no robot and no teacher: refused, named, and nobody else is disturbed."""

import threading

import pytest
from impostor import FLOOD, Impostor, answers
from school import CLASS

from jetbot_cockpit.remote.fleet import Entry
from jetbot_cockpit.remote.key import new_key
from jetbot_ros.contract import COCKPIT_PORT
from web_client import Closed, WebSocket, connect, page_headers

LIAR = "jetbot_99"
MEGABYTE = "x" * 2**20
FLOODS = 8  # threads of a stranger


@pytest.fixture
def listed(lesson):
    """A function that starts an impostor on the stranger's computer, as one of the list of robots."""
    school, started = lesson.school, []

    def start(name, *how, **options):
        started.append(Impostor(school.computers["stranger"], name, *how, **options))
        school.fleet.save([*school.fleet.robots, Entry(LIAR, school.computers["stranger"].address)])
        return started[-1]
    yield start
    school.list_robots()
    for each in started:
        each.close()


def test_a_thief_with_a_recording_of_the_handshake_is_refused(school):
    robot, thief = school.robots[0], school.computers["stranger"]
    recorded, reply = answers(thief, robot.host.address, robot.name, school.fleet.key_of(robot.name))
    assert reply["type"] == "proof", "what was recorded is right"
    for key in new_key(), school.fleet.key_of(school.robots[1].name):
        with pytest.raises(Closed) as refused:
            answers(thief, robot.host.address, robot.name, key)
        assert (refused.value.code, refused.value.reason) == (4005, "wrong key")
    with pytest.raises(Closed) as refused:
        answers(thief, robot.host.address, robot.name, "", recorded)
    assert (refused.value.code, refused.value.reason) == (4005, "wrong key")


WITHOUT_KEY = {
    "a wrong key": lambda fleet: new_key(),
    "another robot's key": lambda fleet: fleet.key_of("jetbot_01")}


@pytest.mark.parametrize("lie", WITHOUT_KEY)
def test_a_robot_without_its_names_key_is_no_robot(lesson, listed, lie):
    impostor = []

    def harm():
        impostor.append(listed("jetbot_02", WITHOUT_KEY[lie](lesson.school.fleet)))
        lesson.teacher.wait(lambda: impostor[0].visits > 2, 10.0, "the hub to try it")
    lesson.others_notice_nothing(lie, harm, lesson.second)
    assert lesson.teacher.robot("jetbot_02")["driver"], "the real one"


def test_a_robot_with_an_old_recording_is_no_robot(lesson, listed):
    key = lesson.school.fleet.key_of(LIAR)
    impostor = listed(LIAR, key)
    lesson.teacher.wait(lambda: impostor.proofs, 10.0, "the proof")
    assert not lesson.teacher.robot(LIAR).get("answers"), "it has no state"
    impostor.recorded, visits = impostor.proofs[0], impostor.visits
    impostor.key = new_key()
    lesson.school.computers["stranger"].set_link("down")
    lesson.teacher.wait(lambda: True, 1.0, "")
    lesson.school.computers["stranger"].set_link("up")


FLOODING = {"floods": FLOOD, "sends a megabyte": MEGABYTE, "sends what is no JSON": "{" * 1000}


@pytest.mark.parametrize("how", FLOODING)
def test_a_robot_that_floods_the_hub_disturbs_no_other(lesson, listed, how):
    lesson.others_notice_nothing(f"a robot that {how}",
                                 lambda: listed(LIAR, lesson.school.fleet.key_of(LIAR), FLOODING[how]), lesson.second)


def test_a_stranger_who_floods_a_robot_disturbs_no_drive(lesson):
    robot, stranger, ended = lesson.first, lesson.school.computers["stranger"], threading.Event()

    def flood():
        while not ended.is_set():
            for path in "/hub", "/socket":
                try:
                    headers = page_headers(COCKPIT_PORT, robot.host.address)
                    if path == "/hub":
                        del headers["Origin"]
                    socket = stranger.call(WebSocket, COCKPIT_PORT, headers, "", robot.host.address, path)
                    socket.send(MEGABYTE.encode())
                    socket.close()
                except (OSError, Closed):
                    pass
    floods = [threading.Thread(target=flood) for _ in range(FLOODS)]
    try:
        lesson.others_notice_nothing("a flooded robot", lambda: [each.start() for each in floods], robot)
    finally:
        ended.set()
        for each in floods:
            each.join()
    with pytest.raises((Closed, OSError)):
        stranger.call(connect, COCKPIT_PORT + 1, "", robot.host.address)
    assert CLASS == "7b"
