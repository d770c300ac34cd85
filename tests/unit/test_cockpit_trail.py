"""Trails on the map."""

from jetbot_cockpit_server.trail import JUMP, MAX_POINTS, MAX_SPEED, RESET_TIME, Trails


def points(trails):
    return {message["robot"]: message["points"] for message in trails.messages()}


def test_a_robot_that_drives_leaves_a_trail_and_one_that_stands_a_point():
    trails = Trails()
    for i in range(11):
        assert trails.update({"/red": (0.01 * i, 0.0, 0.0), "/blue": (2.0, 0.0, 0.0), "/new": None}, 0.05 * i) == []
    assert points(trails)["/blue"] == [[2, 0]]
    assert len(points(trails)["/red"]) == 4
    assert points(trails)["/new"] == []


def test_a_robot_that_is_put_back_starts_again_and_every_page_is_told():
    trails = Trails()
    trails.update({"/red": (1.0, 0.0, 0.0)}, now=0.0)
    assert trails.update({"/red": (0.0, 0.0, 0.0)}, now=0.05) == [{"type": "trail", "robot": "/red", "points": []}]
    assert points(trails) == {"/red": [[0, 0]]}


def test_the_oldest_points_are_dropped_and_robots_that_ended_too():
    trails = Trails()
    for i in range(1000):
        trails.update({"/red": (0.05 * i, 0.0, 0.0)}, 0.05 * i)
    assert len(points(trails)["/red"]) == MAX_POINTS
    trails.update({}, now=50.0)
    assert trails.messages() == []


def test_a_robot_that_is_put_back_near_its_start_starts_again_once_it_is_there():
    trails = Trails()
    for x, now in ((0.0, 0.0), (0.1, 0.1)):
        trails.update({"/red": (x, 0.0, 0.0)}, now)
    trails.reset("/red", now=0.1)
    trails.reset("/ended", now=0.1)
    assert trails.update({"/red": (0.1, 0.0, 0.0)}, now=0.15) == []
    assert trails.update({"/red": (0.0, 0.0, 0.0)}, now=0.2) == []
    assert trails.update({"/red": (0.0, 0.0, 0.0)}, now=0.1 + RESET_TIME) == [
        {"type": "trail", "robot": "/red", "points": []}]
    assert points(trails) == {"/red": [[0, 0]]}
    assert trails.update({"/red": (0.1, 0.0, 0.0)}, now=1.0) == []


def test_a_robot_that_drives_on_while_nobody_looks_keeps_its_trail():
    trails = Trails()
    trails.update({"/red": (0.0, 0.0, 0.0)}, now=0.0)
    far = JUMP + MAX_SPEED * 1.4
    assert trails.update({"/red": (far - 0.01, 0.0, 0.0)}, now=1.4) == []
    assert trails.update({"/red": (-0.3, 0.0, 0.0)}, now=1.45) != []
