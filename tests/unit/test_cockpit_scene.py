"""What the map draws around a robot: markers of any program are decoded, and what no map shows is left out."""

import math
from types import SimpleNamespace as Message

import pytest

from jetbot_cockpit_server import scene
from jetbot_cockpit_server.scene import Scenes, Shape, decode

WALL = Shape("wall", 0.01, ((1.0, 0.0), (1.0, 2.0)))


def same(_, pose):
    return pose


def marker(ns="walls", points=((1, 0), (1, 2)), pose=(0, 0, 0), width=0.01, action=scene.ADD, kind=scene.LINE_STRIP):
    x, y, yaw = pose
    return Message(
        header=Message(frame_id="map"), ns=ns, type=kind, action=action, scale=Message(x=width),
        pose=Message(position=Message(x=x, y=y), orientation=Message(z=math.sin(yaw / 2), w=math.cos(yaw / 2))),
        points=[Message(x=x, y=y) for x, y in points])


def test_polylines_are_drawn_where_they_are():
    assert decode([marker(), marker("lines", width=0.025), marker("course")], same) == (
        WALL, WALL._replace(kind="line", width=0.025), WALL._replace(kind="course"))


def test_a_markers_pose_and_its_frame_move_it():
    turned = marker(pose=(1, 0, math.pi / 2))
    assert decode([turned], same)[0].points == ((1.0, 1.0), (-1.0, 1.0))
    assert decode([marker()], lambda frame, pose: (5.0, pose[1], pose[2]))[0].points == ((6.0, 0.0), (6.0, 2.0))


def test_a_goal_is_an_arrow_from_its_place_in_its_direction():
    goal = marker("goal", points=(), pose=(1, 0.5, math.pi / 2), kind=scene.ARROW)
    assert decode([goal], same)[0].points == ((1.0, 0.5), (1.0, 0.6))


@pytest.mark.parametrize("changes", [
    {"ns": "robots"}, {"kind": 1}, {"kind": scene.ARROW}, {"action": 3}, {"points": ()}, {"points": ((0, 0),)},
    {"points": ((0, math.nan), (1, 1))}, {"points": ((0, 0), (math.inf, 1))}, {"points": ((0, 0), (1e9, 1))},
    {"pose": (math.nan, 0, 0)}, {"pose": (0, 0, math.nan)}, {"width": math.nan},
    {"points": ((0, 0),) * (scene.MAX_POINTS + 1)}], ids=str)
def test_what_no_map_shows_is_left_out_and_the_rest_is_drawn(changes):
    assert decode([marker(**changes), marker()], same) == (WALL,)


def test_there_are_at_most_so_many_points():
    assert sum(len(shape.points) for shape in decode([marker()] * 10000, same)) == scene.MAX_POINTS
    goals = [marker("goal", (), kind=scene.ARROW)] * 10000
    assert sum(len(shape.points) for shape in decode(goals, same)) == scene.MAX_POINTS


def test_pages_get_a_scene_when_it_changes_and_not_otherwise():
    scenes, wall = Scenes(), {"kind": "wall", "width": 0.01, "points": ((1.0, 0.0), (1.0, 2.0))}
    assert scenes.update({"/red": (WALL,), "/blue": ()}) == [{"type": "scene", "robot": "/red", "shapes": [wall]}]
    assert scenes.update({"/red": (WALL,), "/blue": ()}) == []
    assert scenes.update({"/red": (), "/blue": ()}) == [{"type": "scene", "robot": "/red", "shapes": []}]


def test_a_page_that_has_missed_the_end_of_a_scene_is_sent_that_nothing_is_there():
    scenes = Scenes()
    scenes.update({"/red": (WALL,)})
    scenes.update({"/red": ()})
    assert scenes.messages() == [{"type": "scene", "robot": "/red", "shapes": []}]


def test_a_robot_that_comes_back_has_its_scene_again():
    scenes = Scenes()
    for robots, messages in ({"/red": (WALL,)}, 1), ({}, 0), ({"/red": (WALL,)}, 1):
        assert len(scenes.update(robots)) == messages
