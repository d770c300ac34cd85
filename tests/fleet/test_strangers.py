"""Somebody in the network is no robot and no teacher: refused, named, and nobody else is disturbed."""

import contextlib
import threading
import time

import pytest
from impostor import FLOOD, Impostor

from jetbot_cockpit.remote.fleet import Entry
from jetbot_ros.contract import COCKPIT_PORT
from web_client import Closed, WebSocket

LIAR = "jetbot_99"
MEGABYTE, HUGE = "x" * 2**20, b"x" * 100_000
FLOODS = 4  # connections of a stranger at once


FLOODING = {"floods": FLOOD, "sends a megabyte": MEGABYTE, "sends what is no JSON": "{" * 1000}


@pytest.mark.parametrize("how", FLOODING)
def test_a_robot_that_floods_the_hub_disturbs_no_other(lesson, how):
    school, started = lesson.school, []
    host = school.computers["stranger"]

    def appear():
        started.append(Impostor(host, LIAR, school.fleet.key_of(LIAR), FLOODING[how]))
        school.fleet.save([*school.fleet.robots, Entry(LIAR, host.address)])
    try:
        lesson.others_notice_nothing(f"a robot that {how}", appear, lesson.second)
    finally:
        school.list_robots()
        for impostor in started:
            impostor.close()


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
