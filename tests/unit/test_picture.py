"""What a simulated robot sees, against the projection of a pinhole camera that is computed here by itself."""

import math

import pytest

numpy = pytest.importorskip("numpy")
pytest.importorskip("PIL")
from jetbot import bgr8_to_jpeg  # noqa: E402
from jetbot.kinematics import Pose, from_frame  # noqa: E402
from simulation import picture  # noqa: E402
from simulation.picture import LINE, SKY, TILES, WALL, render  # noqa: E402
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


def floor_point(column, row):
    """Return the point of the floor, in the robot's own frame, in the middle of a pixel."""
    right, down = (column + 0.5 - SIZE / 2) / FOCAL_LENGTH, (row + 0.5 - SIZE / 2) / FOCAL_LENGTH
    sinks = SINE + down * COSINE
    return AHEAD + HEIGHT / sinks * (COSINE - down * SINE), -right * HEIGHT / sinks


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


@pytest.mark.parametrize("world, pose", [
    (TRACK, Pose()), (TRACK, Pose(0.62, 0.0, 0.9)), (TRACK, Pose(1.3, 0.83, 0.1)), (TRACK, Pose(-0.2, 0.02, 0.05)),
    (ARENA, Pose(0.2, -0.3, -0.9)), (ARENA, Pose(1.9, 0.6, 1.4)), (LOOP, Pose()), (LOOP, Pose(0.3, -0.2, 1.3))])
def test_each_pixel_of_the_floor_shows_what_the_line_sensor_would_see(world, pose):
    seen, lines = render(World((), world.lines, world.line_width), pose), 0
    for column, row in [(column, row) for row in range(88, SIZE, 5) for column in range(2, SIZE, 5)]:
        corners = [world.reflectance(*from_frame(pose, floor_point(column + x, row + y)))
                   for x in (-0.5, 0.5) for y in (-0.5, 0.5)]
        if corners in ([0] * 4, [1] * 4):
            assert (seen[row, column] < 35).all() if corners == [0] * 4 else (seen[row, column] > 190).all()
            lines += corners == [0] * 4
    assert lines > 5


def test_a_wall_has_its_foot_and_its_top_where_a_pinhole_shows_them():
    seen = render(World(walls=(ACROSS,)), Pose())
    rows = numpy.flatnonzero([is_shade(color, WALL) for color in seen[:, 112, ::-1] / 255])
    assert (rows[0], rows[-1] + 1) == pytest.approx((pixel(0.5, 0, 0.2)[1], pixel(0.5, 0)[1]), abs=1)
    assert is_color(seen[rows[0] - 3, 112, ::-1] / 255, SKY) and is_color(seen[rows[-1] + 3, 112, ::-1] / 255, *TILES)


@pytest.mark.parametrize("end, right", [((0.4, 0.05), 1.5), ((0.7, 0.4), -1.5)])
def test_a_wall_at_an_angle_ends_where_a_pinhole_shows_its_edges(end, right):
    seen = render(World(walls=(((0.4, 0.05), (0.7, 0.4)),)), Pose())
    for z in (0.02, 0.1, 0.18):
        column, row = pixel(*end, z)
        assert is_shade(seen[int(row), int(column - right), ::-1] / 255, WALL)
        assert not is_shade(seen[int(row), int(column + right), ::-1] / 255, WALL)


def test_a_wall_hides_what_is_behind_it_and_a_robot_what_is_beyond():
    line = ((0.8, -2.0), (0.8, 2.0))
    assert is_color(at(render(World(lines=(line,)), Pose()), 0.8, 0), LINE)
    behind = World(walls=(ACROSS, line), lines=(line,))
    assert is_shade(at(render(behind, Pose(), [(Pose(0.8), GREEN)]), 0.8, 0), WALL)
    seen = render(behind, Pose(), [(Pose(0.7), RED), (Pose(0.4), GREEN), (Pose(0.45), RED)])
    assert is_shade(at(seen, 0.305, 0, 0.06), GREEN)
    assert is_shade(at(seen, 0.5, 0, 0.18), WALL)


def test_another_robot_is_a_box_of_its_footprint_in_its_colour():
    seen = render(EMPTY, Pose(1, 2, 0.5), [(Pose(*from_frame(Pose(1, 2, 0.5), (0.5, 0.1)), 0.5), RED)])
    back, left, right = 0.5 + FOOTPRINT.left, 0.1 + FOOTPRINT.top, 0.1 + FOOTPRINT.bottom
    inside = [at(seen, back, y, z) for y in (left - 0.01, right + 0.01) for z in (0.01, 0.11)]
    outside = [at(seen, back, y, z) for y in (left + 0.01, right - 0.015) for z in (0.01, 0.11)]
    assert all(is_shade(color, RED) for color in inside) and not any(is_shade(color, RED) for color in outside)
    assert not is_shade(at(seen, back, 0.1, 0.135), RED)


def test_a_robot_that_stands_askew_shows_two_sides():
    other = Pose(0.45, 0.0, 0.8)
    seen = render(EMPTY, Pose(), [(other, RED)])
    for x, y in ((FOOTPRINT.left, 0.0), (-0.03, FOOTPRINT.top)):
        assert is_shade(at(seen, *from_frame(other, (x, y)), 0.005), RED)
        assert not is_shade(at(seen, *from_frame(other, (1.2 * x, 1.2 * y))), RED)


def test_a_robot_that_touches_a_wall_sees_nothing_else():
    seen = render(World(walls=(ACROSS,)), Pose(0.5 - FOOTPRINT.right - 1e-4))
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
