"""What the camera of a simulated robot sees: floor, lines, walls, other robots, sky. No ROS; it needs numpy and PIL."""

import functools
import math
from typing import Any, Iterable, NamedTuple, Tuple

import numpy
from PIL import Image

from jetbot.camera.lens import AHEAD, HEIGHT, rays
from jetbot.kinematics import Pose, from_frame

from .world import FOOTPRINT, World, segments

Color = Tuple[float, float, float]  # red, green, blue: 0 to 1

SKY, LINE, WALL = (0.75, 0.84, 0.92), (0.12, 0.12, 0.13), (0.80, 0.52, 0.38)
TILES, TILE = ((0.83, 0.82, 0.80), (0.79, 0.78, 0.76)), 0.25  # m
WALL_HEIGHT, ROBOT_HEIGHT = 0.2, 0.12  # m; both above the lens: the nearest hides all others of its height
SHADE, LIGHT = 0.12, 0.5  # how much the direction of a face changes its brightness; rad, of the brightest on the map
TOUCHING = FOOTPRINT.right - AHEAD  # m ahead of the lens; a wall that the robot touches has passed the lens
AT_LENS = 1e6    # 1/m
SAMPLES = 2      # of a pixel, in each direction
BEARINGS = 1024  # in which the nearest wall is looked for


class Optics(NamedTuple):
    """The samples of a picture: down, left of each, as of ``rays``; all bearings (left in 1 m ahead); each's index."""

    down: Any
    left: Any
    bearings: Any
    index: Any


class Scene(NamedTuple):
    """A world on the map: walls and straight strips (n x 2 x 2: start, end), discs in the joints of lines (n x 2)."""

    walls: Any
    strips: Any
    discs: Any
    radius: float


def render(world: World, pose: Pose, others: Iterable[Tuple[Pose, Color]] = (), width: int = 224,
           height: int = 224) -> Any:
    """Return what the robot at a pose sees: height x width x 3, BGR, uint8. others: poses and colours of other robots.

    The same arguments give the same picture.
    """
    optics, scene, others = optics_of(width, height), scene_of(world), list(others)
    lens = Pose(*from_frame(pose, (AHEAD, 0.0)), pose.yaw)
    floor = slice(numpy.searchsorted(optics.down[:, 0], 0, side="right"), None)  # below the horizon
    seen, nearest = numpy.zeros(optics.left.shape, numpy.intp), numpy.zeros(optics.left.shape, numpy.float32)
    seen[floor] = floor_seen(scene, lens, optics.down[floor, 0], optics.left[floor])  # rows of the palette
    palette = [numpy.array([SKY, *TILES, LINE])]
    boxes = numpy.array([box(other) for other, _ in others]).reshape(-1, 2, 2)
    robots = numpy.repeat(numpy.array([color for _, color in others]).reshape(-1, 3), 4, axis=0)
    for faces, colors, top in ((scene.walls, numpy.array(WALL), WALL_HEIGHT), (boxes, robots, ROBOT_HEIGHT)):
        if len(faces):
            add_faces(to_lens(lens, faces), top, optics, sum(map(len, palette)), seen, nearest)
            palette.append(colors * brightness(faces)[:, None])
    return average(numpy.concatenate(palette), seen)


def add_faces(faces: Any, top: float, optics: Optics, first: int, seen: Any, nearest: Any) -> None:
    """Put faces up to a height into what is seen, the first of them as this number, where nothing nearer is."""
    face, constant, factor = nearest_faces(faces, optics.bearings)
    step = optics.bearings[1] - optics.bearings[0]
    largest = (constant + factor * optics.bearings + step * abs(factor)).max()
    rows = slice(*numpy.searchsorted(optics.down[:, 0], [(HEIGHT - top) * largest, HEIGHT * largest]))
    index, down = optics.index[rows], optics.down[rows]
    nearness = constant.take(index) + factor.take(index) * optics.left[rows]
    visible = (nearness > nearest[rows]) & (down < HEIGHT * nearness) & (down > (HEIGHT - top) * nearness)
    numpy.copyto(seen[rows], (first + face).take(index), where=visible)
    numpy.copyto(nearest[rows], nearness, where=visible)


def floor_seen(scene: Scene, lens: Pose, down: Any, left: Any) -> Any:
    """Return the rows of the palette that rays show of the floor. down: one for each row of left."""
    ahead = HEIGHT / down
    cosine, sine = math.cos(lens.yaw), math.sin(lens.yaw)
    x = (lens.x + cosine * ahead)[:, None] - (sine * ahead)[:, None] * left
    y = (lens.y + sine * ahead)[:, None] + (cosine * ahead)[:, None] * left
    floor = 1 + (numpy.floor(x / TILE).astype(numpy.int32) + numpy.floor(y / TILE).astype(numpy.int32) & 1)
    rights, lefts = (numpy.concatenate(each) for each in zip(
        cut_strips(to_lens(lens, scene.strips), scene.radius, ahead.astype(float)),
        cut_discs(to_lens(lens, scene.discs), scene.radius, ahead.astype(float))))
    first, step = left[:, :1].T.astype(float), (left[:, 0] - left[:, 1]).astype(float)
    begins, ends = (numpy.clip(numpy.ceil((first - each / ahead) / step), 0, left.shape[1]).astype(numpy.intp)
                    for each in (lefts, rights))
    floor[filled(begins, ends, left.shape)] = 1 + len(TILES)
    return floor


def cut_strips(strips: Any, radius: float, ahead: Any) -> Tuple[Any, Any]:
    """Return where strips cut the lines across at these distances ahead: y of right and left end, strips x distances.

    The right end is left of the left one where they do not.
    """
    start, along = strips[:, 0], strips[:, 1] - strips[:, 0]
    length = numpy.hypot(*along.T)[:, None]
    cosine, sine = along.T[:, :, None] / length
    x, y = ahead - start[:, :1], start[:, 1:]
    low, high = between(x * cosine, sine, 0.0, length)
    right, left = between(-x * sine, cosine, -radius, radius)
    return y + numpy.maximum(low, right), y + numpy.minimum(high, left)


def between(offset: Any, factor: Any, low: Any, high: Any) -> Tuple[Any, Any]:
    """Return the least and the largest y with low <= offset + factor * y <= high."""
    factor = numpy.where(abs(factor) < 1e-9, 1e-9, factor)
    ends = (low - offset) / factor, (high - offset) / factor
    return numpy.minimum(*ends), numpy.maximum(*ends)


def cut_discs(discs: Any, radius: float, ahead: Any) -> Tuple[Any, Any]:
    """Do the same as ``cut_strips`` with discs."""
    square = radius ** 2 - (ahead - discs[:, :1]) ** 2
    half = numpy.where(square > 0, numpy.sqrt(abs(square)), -1.0)
    return discs[:, 1:] - half, discs[:, 1:] + half


def filled(begins: Any, ends: Any, shape: Tuple[int, int]) -> Any:
    """Return which samples of rows are in one of the ranges from begin to end; each array: ranges x rows."""
    rows, columns = shape
    row = numpy.broadcast_to(numpy.arange(rows) * (columns + 1), begins.shape)
    real = begins < ends
    depth = (numpy.bincount((row + begins)[real], minlength=rows * (columns + 1))
             - numpy.bincount((row + ends)[real], minlength=rows * (columns + 1)))
    return numpy.cumsum(depth.astype(numpy.int16), dtype=numpy.int16).reshape(rows, columns + 1)[:, :-1] > 0


def nearest_faces(faces: Any, bearings: Any) -> Tuple[Any, Any, Any]:
    """Return the face that is seen first at each bearing, and how near it is: 1 / m ahead is constant + factor * left.

    faces: n x 2 x 2, in the frame of the lens. 0 is nothing; what the robot touches is as good as at the lens.
    """
    (x, y), (along_x, along_y) = faces[:, 0].T[:, :, None], (faces[:, 1] - faces[:, 0]).T[:, :, None]
    cross = x * along_y - y * along_x
    cross = numpy.where(abs(cross) < 1e-12, 1e-12, cross)  # seen along its edge
    slope = along_y - along_x * bearings
    part = (x * bearings - y) * numpy.sign(slope)  # of the face's length, times abs(slope)
    nearness = numpy.where((part >= -1e-9) & (part <= abs(slope) + 1e-9), slope / cross, 0)
    nearness[nearness < 1 / TOUCHING] = AT_LENS
    face, nearness = nearness.argmax(axis=0), nearness.max(axis=0)
    plane = (nearness > 0) & (nearness < AT_LENS)
    constant = numpy.where(plane, (along_y / cross)[face, 0], numpy.where(nearness > 0, AT_LENS, 0))
    factor = numpy.where(plane, (-along_x / cross)[face, 0], 0)
    return face, constant.astype(numpy.float32), factor.astype(numpy.float32)


def to_lens(lens: Pose, points: Any) -> Any:
    """Return points of the map in the frame of the lens, as ``kinematics.to_frame``."""
    x, y = points[..., 0] - lens.x, points[..., 1] - lens.y
    cosine, sine = math.cos(lens.yaw), math.sin(lens.yaw)
    return numpy.stack([cosine * x + sine * y, cosine * y - sine * x], axis=-1)


def box(pose: Pose) -> Any:
    """Return the four sides of the robot at a pose."""
    corners = [from_frame(pose, FOOTPRINT.corners[number]) for number in (0, 1, 3, 2)]
    return list(zip(corners, corners[1:] + corners[:1]))


def brightness(faces: Any) -> Any:
    """Return how bright each face is, by its direction on the map: about 1."""
    along = faces[:, 1] - faces[:, 0]
    return 1 - SHADE + SHADE * numpy.cos(2 * (numpy.arctan2(along[:, 1], along[:, 0]) - LIGHT))


def average(palette: Any, seen: Any) -> Any:
    """Return the picture: BGR, each pixel the mean of its samples, which are rows of the palette."""
    samples = numpy.rint(255 * palette[:, ::-1]).astype(numpy.uint8).take(seen, axis=0)
    return numpy.asarray(Image.fromarray(samples).reduce(SAMPLES))


@functools.lru_cache(maxsize=2)
def optics_of(width: int, height: int) -> Optics:
    """Return the samples of a picture."""
    down, left = rays(SAMPLES * width, SAMPLES * height)
    bearings = numpy.linspace(left.min(), left.max(), BEARINGS)
    index = numpy.rint((left - bearings[0]) / (bearings[1] - bearings[0])).astype(numpy.intp)
    return Optics(down.astype(numpy.float32), left.astype(numpy.float32), bearings, index)


@functools.lru_cache(maxsize=32)
def scene_of(world: World) -> Scene:
    """Return a world as arrays; its lines have the joints and ends of ``World.reflectance``."""
    discs = [point for line in world.lines for point in (line if line[0] == line[-1] else line[1:-1])]
    walls, strips = (numpy.array([each for each in segments(polylines) if each[0] != each[1]]).reshape(-1, 2, 2)
                     for polylines in (world.walls, world.lines))
    return Scene(walls, strips, numpy.array(discs).reshape(-1, 2), world.line_width / 2)
