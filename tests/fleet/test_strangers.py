"""Somebody in the network is no robot and no teacher: refused, named, and nobody else is disturbed."""

import contextlib
import threading
import time

import pytest
from impostor import FLOOD, Impostor, answers

from jetbot_cockpit.remote.fleet import Entry
from jetbot_cockpit.remote.key import new_key
from jetbot_ros.contract import COCKPIT_PORT
from web_client import Closed, WebSocket

LIAR = "jetbot_99"
MEGABYTE, HUGE = "x" * 2**20, b"x" * 100_000
FLOODS = 4  # connections of a stranger at once


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


@pytest.mark.short
def test_a_thief_with_a_recording_of_the_handshake_is_refused(school):
    robot, thief = school.robots[0], school.computers["stranger"]
    recorded, reply = answers(thief, robot.host.address, school.fleet.key_of(robot.name))
    assert reply["type"] == "proof", "what was recorded is right"
    for key in new_key(), school.fleet.key_of(school.robots[1].name):
        with pytest.raises(Closed) as refused:
            answers(thief, robot.host.address, key)
        assert (refused.value.code, refused.value.reason) == (4005, "wrong key")
    with pytest.raises(Closed) as refused:
        answers(thief, robot.host.address, "", recorded)
    assert (refused.value.code, refused.value.reason) == (4005, "wrong key")


WITHOUT_KEY = {
    "a wrong key": lambda fleet: new_key(),
    "another robot's key": lambda fleet: fleet.key_of("jetbot_01")}


@pytest.mark.parametrize("lie", WITHOUT_KEY)
def test_a_robot_without_its_names_key_is_no_robot(lesson, listed, lie):
    impostor = []

    def harm():
        impostor.append(listed("jetbot_02", WITHOUT_KEY[lie](lesson.school.fleet)))
        lesson.teacher.wait(lambda: impostor[0].visits, 10.0, "the hub to try it")
    lesson.others_notice_nothing(lie, harm, lesson.second)
    assert lesson.teacher.robot("jetbot_02")["driver"], "the real one"


def test_a_robot_that_replays_a_proof_is_no_robot(lesson, listed):
    key = lesson.school.fleet.key_of(LIAR)
    recording = listed(LIAR, key)
    lesson.teacher.wait(lambda: recording.proofs, 10.0, "a proof")
    recording.close()
    thief = listed(LIAR, new_key(), recorded=recording.proofs[0])
    lesson.teacher.wait(lambda: thief.proofs, 10.0, "the hub to try it")
    lesson.teacher.wait(lambda: lesson.teacher.robot(LIAR).get("cause") == "forged", 5.0, "the page to say so")
    assert not lesson.teacher.robot(LIAR)["answers"]


FLOODING = {"floods": FLOOD, "sends a megabyte": MEGABYTE, "sends what is no JSON": "{" * 1000}


@pytest.mark.parametrize("how", FLOODING)
def test_a_robot_that_floods_the_hub_disturbs_no_other(lesson, listed, how):
    lesson.others_notice_nothing(f"a robot that {how}",
                                 lambda: listed(LIAR, lesson.school.fleet.key_of(LIAR), FLOODING[how]), lesson.second)


def test_a_stranger_who_floods_a_robot_disturbs_no_other_and_does_not_keep_it_from_stopping(lesson):
    robot, stranger, ended = lesson.first, lesson.school.computers["stranger"], threading.Event()

    def flood():
        while not ended.wait(0.001):
            with contextlib.suppress(OSError, Closed, IndexError):
                socket = stranger.call(WebSocket, COCKPIT_PORT, {"Host": f"{robot.host.address}:{COCKPIT_PORT}"}, "",
                                       robot.host.address, "/hub")
                socket.send(HUGE)
                socket.close()
    floods = [threading.Thread(target=flood) for _ in range(FLOODS)]
    try:
        lesson.others_notice_nothing("a flooded robot", lambda: [each.start() for each in floods], lesson.second)
        stopped_at = time.monotonic()
        lesson.teacher.send(type="stop")
        lesson.stops(robot, stopped_at, "STOP of a flooded robot")
    finally:
        ended.set()
        for each in floods:
            each.join()
