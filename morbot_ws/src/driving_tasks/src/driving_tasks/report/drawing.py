"""A picture of a judged drive from above: the ideal and the driven line, and where points were lost."""

import io
import math
from typing import List, Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from jetbot import files
from jetbot.kinematics import Point, Pose, from_frame
from simulation.world import FOOTPRINT, World

from ..scoring.course import Course
from ..scoring.penalties import Loss
from ..scoring.recorder import Drive
from ..scoring.score import NEGLIGIBLE, NO_LOSS, Result

BLUE, ORANGE, GREEN, RED = "tab:blue", "tab:orange", "tab:green", "tab:red"
WIDTH, HEIGHT = 10, 7     # inches, of the floor
TEXT = 0.34               # inches of each line below it
MAX_POINTS = 5000         # of the driven line that are drawn
NEAR = 0.05               # m; the numbers of places that are nearer to each other would cover each other
HEADINGS = 8              # along the driven line
IDEAL = {"color": ORANGE, "linewidth": 6, "alpha": 0.5, "label": "ideal", "solid_capstyle": "round"}
DRIVEN = {"color": BLUE, "linewidth": 2, "label": "driven"}
WALL = {"color": "black", "linewidth": 5, "solid_capstyle": "butt"}
TAPE = {"color": "0.75", "linewidth": 12, "solid_capstyle": "butt"}


def draw(result: Result, file: str, note: str = "") -> None:
    """Draw a result, with a note below its title, into a PNG file, 1000 pixels wide, in one step. Raises OSError."""
    task, drive, losses = result.task, result.drive, [loss for loss in result.losses if loss.points >= NEGLIGIBLE]
    below = TEXT * max(1, len(losses)) + 0.3
    figure = Figure(figsize=(WIDTH, HEIGHT + below), constrained_layout=True)
    title = f"{task.title}: {result.score:.1f} of 100 points in {drive.seconds:.1f} s"
    figure.suptitle(f"{title}\n{note}".rstrip(), fontsize=16)
    floor, text = figure.subplots(2, gridspec_kw={"height_ratios": (HEIGHT, below)})
    draw_world(floor, task.load_world())
    draw_drive(floor, task.course, drive)
    mark_losses(floor, losses)
    list_losses(text, losses)
    picture = io.BytesIO()
    figure.savefig(picture, format="png", dpi=100)
    files.replace(file, picture.getvalue())


def draw_drive(axes: Axes, course: Course, drive: Drive) -> None:
    """Draw the course and the drive from above."""
    path = drive.poses[::1 + len(drive.path) // MAX_POINTS]
    if course.steps:
        axes.plot(*zip(*course.points), **IDEAL)
    axes.plot([pose.x for pose in path], [pose.y for pose in path], **DRIVEN)
    for pose in path[::max(1, len(path) // HEADINGS)]:
        axes.quiver(pose.x, pose.y, math.cos(pose.yaw), math.sin(pose.yaw), color=BLUE, zorder=3, pivot="mid",
                    headlength=4, headaxislength=4, scale=45, width=0.005)
    goal = (course.goal, {"edgecolor": ORANGE, "linestyle": "--", "label": "goal"})
    for pose, style in ((Pose(), {"edgecolor": GREEN, "label": "start"}), *[goal] * bool(course.steps),
                        (drive.end, {"edgecolor": BLUE, "label": "stop"})):
        draw_robot(axes, pose, style)
    axes.set(xlabel="x (m)", ylabel="y (m)")
    axes.set_aspect("equal", "datalim")
    axes.grid(alpha=0.3)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncol=7, frameon=False)


def draw_world(axes: Axes, world: World) -> None:
    """Draw walls, and the lines on the floor."""
    for polylines, style, label in (world.lines, TAPE, "tape"), (world.walls, WALL, "wall"):
        for number, polyline in enumerate(polylines):
            axes.plot(*zip(*polyline), label="" if number else label, **style)


def draw_robot(axes: Axes, pose: Pose, style: dict) -> None:
    """Draw the robot's outline at a pose, with a line from its centre to its front."""
    axes.fill(*zip(*outline(pose)), facecolor="none", linewidth=2, zorder=4, **style)
    front = from_frame(pose, (FOOTPRINT.right, 0.0))
    axes.plot([pose.x, front[0]], [pose.y, front[1]], color=style["edgecolor"], zorder=4)


def outline(pose: Pose) -> List[Point]:
    """Return the corners of the robot at a pose, one after the other."""
    back_right, back_left, front_right, front_left = (from_frame(pose, corner) for corner in FOOTPRINT.corners)
    return [back_right, back_left, front_left, front_right]


def mark_losses(axes: Axes, losses: Sequence[Loss]) -> None:
    """Draw the number of each loss beside its place, one beside the other where several have about the same place."""
    middle, places = sum(axes.get_xlim()) / 2, []
    for number, loss in enumerate(losses, 1):
        side = -1 if loss.place[0] > middle else 1  # away from the edge of the picture
        offset = side * (18 + 26 * sum(math.dist(place, loss.place) < NEAR for place in places))
        places.append(loss.place)
        axes.plot(*loss.place, marker="x", markersize=10, markeredgewidth=3, color=RED, zorder=5)
        axes.annotate(str(number), loss.place, (offset, 18), textcoords="offset points", ha="center", fontsize=13,
                      color="white", zorder=6, bbox={"boxstyle": "circle", "color": RED})


def list_losses(axes: Axes, losses: Sequence[Loss]) -> None:
    """Write the sentence of each loss, and its points."""
    axes.axis("off")
    for number, loss in enumerate(losses, 1):
        axes.text(0, 1 - (number - 1) / len(losses), f"{number}  {loss.sentence} ({loss.points:.1f} points)",
                  fontsize=13, va="top", color=RED)
    if not losses:
        axes.text(0, 1, str(NO_LOSS), fontsize=13, va="top")
