"""Trails on the map."""

from jetbot_cockpit.trail import MAX_POINTS, Trails


def points(trails):
    return {message["robot"]: message["points"] for message in trails.messages()}


def test_a_robot_that_drives_leaves_a_trail_and_one_that_stands_a_point():
    trails = Trails()
    for i in range(11):
        assert trails.update({"/red": (0.01 * i, 0.0, 0.0), "/blue": (2.0, 0.0, 0.0), "/new": None}) == []
    assert points(trails)["/blue"] == [[2, 0]]
    assert len(points(trails)["/red"]) == 4
    assert points(trails)["/new"] == []


def test_a_robot_that_is_put_back_starts_again_and_every_page_is_told():
    trails = Trails()
    trails.update({"/red": (1.0, 0.0, 0.0)})
    assert trails.update({"/red": (0.0, 0.0, 0.0)}) == [{"type": "trail", "robot": "/red", "points": []}]
    assert points(trails) == {"/red": [[0, 0]]}


def test_the_oldest_points_are_dropped_and_robots_that_ended_too():
    trails = Trails()
    for i in range(1000):
        trails.update({"/red": (0.05 * i, 0.0, 0.0)})
    assert len(points(trails)["/red"]) == MAX_POINTS
    trails.update({})
    assert trails.messages() == []
