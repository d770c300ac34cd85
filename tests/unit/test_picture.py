"""What a simulated robot sees, against the projection of a pinhole camera that is computed here by itself."""

import math
from collections import Counter
from random import Random

import pytest

numpy = pytest.importorskip("numpy")
pytest.importorskip("PIL")
from jetbot import bgr8_to_jpeg  # noqa: E402
from jetbot.kinematics import Pose, from_frame  # noqa: E402
from simulation import picture  # noqa: E402
from simulation.picture import SKY, TILES, WALL, render  # noqa: E402
from simulation.world import EMPTY, FOOTPRINT, World  # noqa: E402
from simulation.world_files import load  # noqa: E402

SIZE, FOCAL_LENGTH = 224, 145.96  # pixels: 112 / tan(75 deg / 2)
HEIGHT, AHEAD = 0.108, 0.066      # m, of the lens
COSINE, SINE = math.cos(math.radians(19)), math.sin(math.radians(19))
ACROSS = ((0.5, -2.0), (0.5, 2.0))
TRACK, ARENA = load("line.yaml"), load("arena.yaml")
LOOP = World(lines=(((0.25, 0.0), (0.5, 0.1), (0.5, -0.1), (0.25, 0.0)),), line_width=0.08)
GREEN, RED = (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)


def pixel(x, y, z=0.0):
    """Return where a point of the robot's own frame is in the picture: from the left, from above, in pixels."""
    forward, up = x - AHEAD, z - HEIGHT
    depth, down = forward * COSINE - up * SINE, -forward * SINE - up * COSINE
    return SIZE / 2 - FOCAL_LENGTH * y / depth, SIZE / 2 + FOCAL_LENGTH * down / depth


def at(seen, x, y, z=0.0):
    """Return the colour of a picture where a point is: red, green, blue, 0 to 1."""
    column, row = pixel(x, y, z)
    return seen[int(row), int(column), ::-1] / 255


def is_color(color, *others):
    return any(numpy.allclose(color, other, atol=0.01) for other in others)


def is_shade(color, other):
    """Return whether this is the other colour, somewhat brighter or darker."""
    ratio = numpy.linalg.norm(color) / numpy.linalg.norm(other)
    return 0.7 < ratio < 1.05 and numpy.allclose(color, ratio * numpy.array(other), atol=0.02)


def what_is_at(column, row, faces, world, here):
    """Return what a pixel shows in its middle: a face's colour, 1.0 for the floor, 0.0 for a line.

    faces: (color, height, end, other end) of each that is upright, in the robot's own frame.
    """
    right, down = (column + 0.5 - SIZE / 2) / FOCAL_LENGTH, (row + 0.5 - SIZE / 2) / FOCAL_LENGTH
    forward, rises = COSINE - down * SINE, -SINE - down * COSINE
    seen, nearest = SKY, math.inf
    if rises < 0:
        nearest = -HEIGHT / rises
        seen = world.reflectance(*from_frame(here, (AHEAD + nearest * forward, -nearest * right)))
    for color, height, (x, y), (end_x, end_y) in faces:
        along_x, along_y, ahead = end_x - x, end_y - y, x - AHEAD
        crossing = forward * along_y + right * along_x or 1e-9
        distance, part = (ahead * along_y - y * along_x) / crossing, -(forward * y + right * ahead) / crossing
        if 0 < distance < nearest and 0 <= part <= 1 and HEIGHT + distance * rises <= height:
            seen, nearest = color, distance
    return seen


def is_seen(color, expected):
    """Return whether a pixel's colour is what it must show."""
    if expected in (0.0, 1.0):
        return max(color) < 35 / 255 if expected == 0.0 else min(color) > 190 / 255
    return is_color(color, SKY) if expected is SKY else is_shade(color, expected)


@pytest.mark.parametrize("world, here", [
    (TRACK, Pose()), (TRACK, Pose(0.62, 0.0, 0.9)), (TRACK, Pose(1.3, 0.83, 0.1)), (TRACK, Pose(-0.2, 0.02, 0.05)),
    (ARENA, Pose(0.2, -0.3, -0.9)), (ARENA, Pose(1.9, 0.6, 1.4)), (LOOP, Pose()), (LOOP, Pose(0.3, -0.2, 1.3))])
def test_each_pixel_shows_what_is_nearest_there_a_wall_a_robot_a_line_or_the_floor(world, here):
    numbers = Random(str((here, world.lines)))
    points = [(numbers.uniform(0.3, 1.5), numbers.uniform(-0.8, 0.8)) for _ in range(4)]
    walls = points[:2], points[2:]
    robots = [(Pose(numbers.uniform(0.4, 1), numbers.uniform(-0.4, 0.4), numbers.uniform(-3, 3)), color)
              for color in (RED, GREEN)]
    faces = [(WALL, 0.2, *wall) for wall in walls]
    for pose, color in robots:
        corners = [from_frame(pose, (x, y)) for x, y in (
            (FOOTPRINT.left, FOOTPRINT.top), (FOOTPRINT.right, FOOTPRINT.top), (FOOTPRINT.right, FOOTPRINT.bottom),
            (FOOTPRINT.left, FOOTPRINT.bottom))]
        faces += [(color, 0.12, *ends) for ends in zip(corners, corners[1:] + corners[:1])]
    world = World(tuple(tuple(from_frame(here, point) for point in wall) for wall in walls), world.lines,
                  world.line_width)
    seen = render(world, here, [
        (Pose(*from_frame(here, pose[:2]), here.yaw + pose.yaw), color) for pose, color in robots])
    shown = Counter()
    for column, row in [(column, row) for row in range(2, SIZE, 6) for column in range(2, SIZE, 6)]:
        corners = {what_is_at(column + x, row + y, faces, world, here) for x in (-1.2, 1.2) for y in (-1.2, 1.2)}
        expected = corners.pop()
        if not corners and expected in (SKY, WALL, RED, GREEN, *((0.0, 1.0) if row >= 88 else ())):  # it is at no edge
            assert is_seen(seen[row, column, ::-1] / 255, expected), (column, row, expected)
            shown[expected] += 1
    assert len(shown) > 4 and shown[0.0], "there is something to see"


def test_a_robot_that_touches_a_wall_sees_nothing_else_and_no_line_behind_it():
    seen = render(World(walls=(ACROSS,), lines=(ACROSS,)), Pose(0.5 - FOOTPRINT.right - 1e-4))
    assert is_shade(seen[0, 0, ::-1] / 255, WALL) and (seen == seen[0, 0]).all()
    assert not is_shade(at(render(World(walls=(ACROSS,)), Pose(0.5)), 1.0, 0), WALL)


def test_the_tiles_stay_on_the_map():
    seen = render(EMPTY, Pose(0.1, 0.1))
    assert is_color(at(seen, 0.25 - 0.1 + 0.02, 0), TILES[1]) and is_color(at(seen, 0.25 - 0.1 - 0.005, 0), TILES[0])
    seen = render(EMPTY, Pose(0.1, 0.1, math.pi / 2))
    assert is_color(at(seen, 0.25, 0.09), TILES[1]) and is_color(at(seen, 0.25, 0.11), TILES[0])


def test_the_same_pose_gives_the_same_jpeg():
    world, pose, others = ARENA, Pose(0.3, -0.2, 0.7), [(Pose(0.7, 0.1), RED)]
    jpegs = set()
    for _ in range(2):
        picture.optics_of.cache_clear()
        picture.scene_of.cache_clear()
        jpegs.add(bgr8_to_jpeg(render(world, pose, others)))
    assert len(jpegs) == 1
    assert bgr8_to_jpeg(render(world, pose._replace(yaw=0.72), others)) not in jpegs


@pytest.mark.parametrize("world", [
    EMPTY, World(walls=(((1.0, 1.0), (1.0, 1.0)),)), World(walls=(((AHEAD, 0.0), (1.0, 0.0)),)),
    World(lines=(((0.4, 0.0), (0.4, 0.0)), ((0.3, 0.0), (0.3, 0.0), (0.5, 0.0)), ((1000.0, 0.0), (-1000.0, 0.0))))])
def test_odd_worlds_are_drawn_without_a_warning(world, recwarn):
    assert render(world, Pose(), width=32, height=24).shape == (24, 32, 3)
    assert not recwarn.list
