"""The simulated world: how far a wall is, what the line sensor sees, which files are worlds."""

import math
import re
import xml.etree.ElementTree as ET

import pytest

from conftest import ROOT, SIMULATION
from jetbot import InvalidValue
from jetbot.kinematics import Pose
from simulation.world import EMPTY, FOOTPRINT, World
from simulation.world_files import dump, load, names, parse

WALL = World(walls=(((1.0, -1.0), (1.0, 1.0)),))
POST = World(walls=(((1.0, 1.0), (1.0, 1.0)),))
TAPE = World(lines=(((0.0, 0.0), (1.0, 0.0)),), line_width=0.02)
FRONT, SIDE, BACK = FOOTPRINT.right, FOOTPRINT.top, -FOOTPRINT.left


def test_the_footprint_holds_the_drawn_robot():
    robot = ET.parse(SIMULATION / "urdf/jetbot.urdf").getroot()
    case = robot.find("link[@name='base_link']/visual")
    middle, length = (float(case.find(place).get(key).split()[0]) for place, key in (
        ("origin", "xyz"), ("geometry/box", "size")))
    assert (FOOTPRINT.left, FOOTPRINT.right) == pytest.approx((middle - length / 2, middle + length / 2))
    wheel = robot.find("link[@name='left_wheel']/visual/geometry/cylinder")
    axle = float(robot.find("joint[@name='left_wheel_joint']/origin").get("xyz").split()[1])
    assert FOOTPRINT.top == -FOOTPRINT.bottom == pytest.approx(axle + float(wheel.get("length")) / 2, abs=0.002)


@pytest.mark.parametrize("world, pose, clearance", [
    (EMPTY, Pose(), math.inf),
    (WALL, Pose(), 1 - FRONT),
    (WALL, Pose(0.0, 0.0, math.pi / 2), 1 - SIDE),
    (WALL, Pose(0.0, 0.0, math.pi / 4), 1 - (FRONT + SIDE) / math.sqrt(2)),
    (WALL, Pose(2.0, 0.0, 0.0), 1 - BACK),
    (WALL, Pose(1.0, 2.0, 0.0), 1 - SIDE),
    (WALL, Pose(1.0, 0.0, 0.3), 0.0),
    (POST, Pose(), math.hypot(1 - FRONT, 1 - SIDE)),
    (POST, Pose(1.02, 1.01, 0.5), 0.0)])
def test_the_clearance_is_the_distance_of_the_footprint_from_the_nearest_wall(world, pose, clearance):
    assert world.clearance(pose) == pytest.approx(clearance, abs=1e-9)


def test_a_world_is_placed_with_its_origin_at_a_pose():
    placed = World(TAPE.lines, TAPE.lines, 0.02).placed(Pose(1.0, 2.0, math.pi / 2))
    assert [tuple(round(value, 9) for value in point) for point in placed.walls[0]] == [(1, 2), (1, 3)]
    assert (placed.lines, placed.line_width) == (placed.walls, 0.02)
    pose = Pose(0.3, 0.1, 0.7)
    moved = Pose(1.0 - pose.y, 2.0 + pose.x, pose.yaw + math.pi / 2)
    assert WALL.placed(Pose(1.0, 2.0, math.pi / 2)).clearance(moved) == pytest.approx(WALL.clearance(pose))


@pytest.mark.parametrize("outside, seen", [(-0.01, 0), (-0.005, 0), (-0.0025, 0.25), (0.0, 0.5), (0.0025, 0.75),
                                           (0.005, 1), (0.5, 1)])
def test_an_eye_sees_the_edge_of_the_tape_fade_over_a_spot_of_5_mm_radius(outside, seen):
    for x, y in ((0.5, 0.01 + outside), (0.5, -0.01 - outside), (1 + outside, 0.0), (-outside, 0.0)):
        assert TAPE.reflectance(x, y) == pytest.approx(seen)
    assert EMPTY.reflectance(0.5, outside) == 1


@pytest.mark.parametrize("line, point, outside", [
    (((0, 0), (1, 0), (1, 1)), (1.008, -0.008), math.hypot(0.008, 0.008) - 0.01),  # round where it bends
    (((0, 0), (1, 0), (1, 1)), (1.0, 1.003), 0.003),                               # straight where it ends
    (((0, 0), (1, 0), (1, 1), (0, 0)), (-0.01, 0.0), 0.0),                         # no end where it leads back
    (((0, 0), (0, 0)), (-0.01, 0.0), 0.0)])                                        # a point twice
def test_the_shape_of_tape(line, point, outside):
    assert World(lines=(line,), line_width=0.02).reflectance(*point) == pytest.approx(0.5 + outside / 0.01)


@pytest.mark.parametrize("pose, eyes", [
    (Pose(0.2, 0.0, 0.0), (1, 0, 1)), (Pose(0.2, 0.015, 0.0), (1, 1, 0)), (Pose(0.2, -0.015, 0.0), (0, 1, 1)),
    (Pose(0.2, 0.005, 0.0), (1, 0, 0.5)), (Pose(0.2, -0.05, math.pi / 2), (0, 0, 0)),
    (Pose(1.0, 0.0, math.pi), (1, 0, 1)), (Pose(1.0, 0.0, 0.0), (1, 1, 1))])
def test_the_eyes_are_at_the_left_the_middle_and_the_right_below_the_front(pose, eyes):
    assert TAPE.line_sensor(pose) == pytest.approx(eyes)


def test_yaml_is_a_world_at_its_origin():
    text = "walls: [[[0, 0], [1, 0], [1, 1]]]\nlines: [[[0, 0], [0.5, 0]]]\nline_width: 0.03\n"
    world = World((((0, 0), (1, 0), (1, 1)),), (((0, 0), (0.5, 0)),), 0.03)
    assert parse(text) == parse(dump(world)) == world
    assert parse(f"{text}origin: [1, 2, 0.5]") == world.placed(Pose(1, 2, 0.5))
    assert parse("{}") == EMPTY


@pytest.mark.parametrize("text, reason", [
    ("walls: 3", "walls must be a list of polylines, each a list of points [x, y], not 3"),
    ("lines: [[[0, 0]]]", "polyline 1 of lines must be a list of two points [x, y] or more, not [[0, 0]]"),
    ("walls: [[0, 0], [1, 0]]", "point 1 in polyline 1 of walls must be [x, y] in m, within 1000, not 0"),
    ("walls: [[[0, 0], [.nan, 0]]]", "point 2 in polyline 1 of walls must be [x, y] in m, within 1000, not [nan, 0]"),
    ("wals: []", "there is no wals: in a world. The keys are walls, lines, line_width and origin"),
    ("walls: &a [[[0, 0], [1, 1]]]\nlines: *a", "write each point out, without *"),
    ("line_width: 0", "line_width must be a number of metres above 0, 1 at most, not 0"),
    ("origin: [0, 0]", "origin must be [x, y, yaw] in m and rad, within 1000, not [0, 0]"),
    ("walls: [", "line 1: expected the node content, but found '<stream end>'"),
    (f"walls: [[{'[0, 0], ' * 1001}]]", "its walls and lines have more than 1000 points")],
    ids=lambda value: ascii(value)[:30])
def test_another_text_is_refused_with_the_reason_in_one_sentence(text, reason):
    with pytest.raises(InvalidValue) as error:
        parse(text, "the world x.yaml")
    assert str(error.value).startswith(f"The world x.yaml cannot be used: {reason}")
    assert "\n" not in str(error.value)


def test_a_shipped_world_is_found_by_its_name_and_another_one_by_its_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("own.yaml", "arena.yaml"):
        (tmp_path / name).write_text("walls: [[[0, 0], [1, 0]]]")
    assert load("own.yaml") == load(str(tmp_path / "arena.yaml")) == World((((0, 0), (1, 0)),))
    assert load("arena.yaml") == parse((SIMULATION / "worlds/arena.yaml").read_text())  # as a task needs it


def test_a_world_that_is_missing_is_named_by_its_path_with_those_there_are(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InvalidValue, match=f"world {tmp_path}/own.yaml .* The simulation has arena.yaml, "):
        load("own.yaml")


def test_in_the_shipped_worlds_the_robots_are_free_at_their_starts():
    assert [name for name in names() if load(name).clearance(Pose()) <= 0.25] == [], "a wall is too near in these"


def test_the_example_of_the_page_is_a_world():
    page = (ROOT / "docs/worlds.md").read_text()
    [example] = re.findall(r"^```yaml\n(.*?)^```", page, re.M | re.S)
    assert (len(parse(example).walls), len(parse(example).lines)) == (2, 1)
