"""A picture of a recording: the track from above, and the speeds over time."""

import io
import math
from typing import Callable, Sequence

from geometry_msgs.msg import Twist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from jetbot import files

from .diff_drive import Pose
from .recording import Recording

BLUE, ORANGE, GREEN, RED = "tab:blue", "tab:orange", "tab:green", "tab:red"
COMMANDED = {"label": "commanded", "color": ORANGE, "linewidth": 4, "alpha": 0.6, "drawstyle": "steps-post"}
ACTUAL = {"label": "actual", "color": BLUE, "linewidth": 1.5}
ARROWS = 8  # along the track


def draw(recording: Recording, file: str) -> None:
    """Draw a recording that holds odometry into a PNG file; raise OSError if it cannot be written."""
    figure = Figure(figsize=(7, 9), constrained_layout=True)
    track, linear, angular = figure.subplots(3, gridspec_kw={"height_ratios": (5, 1.2, 1.2)})
    draw_track(track, recording.poses)
    draw_speed(linear, recording, lambda twist: twist.linear.x, "speed (m/s)")
    draw_speed(angular, recording, lambda twist: twist.angular.z, "turn (rad/s)")
    linear.tick_params(labelbottom=False)
    linear.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncol=2, frameon=False)
    angular.set_xlabel("time (s)")
    figure.align_ylabels()
    picture = io.BytesIO()
    figure.savefig(picture, format="png", dpi=100)
    files.replace(file, picture.getvalue())


def draw_track(axes: Axes, poses: Sequence[Pose]) -> None:
    """Draw the track from above, with arrows in the direction of the heading."""
    axes.plot([pose.x for pose in poses], [pose.y for pose in poses], color=BLUE, linewidth=2)
    for pose in poses[::max(1, len(poses) // ARROWS)]:
        draw_heading(axes, pose, BLUE, scale=40, width=0.006)
    for name, pose, color in ("start", poses[0], GREEN), ("end", poses[-1], RED):
        draw_heading(axes, pose, color, scale=22, width=0.011)
        axes.plot([], [], marker=(3, 0, -90), markersize=11, linestyle="", color=color,
                  label=f"{name}: x {pose.x:.2f} m, y {pose.y:.2f} m, heading {math.degrees(pose.yaw):.0f}°")
    axes.legend(loc="upper left")
    axes.set_aspect("equal", "datalim")
    axes.margins(0.1)
    axes.set(xlabel="x (m)", ylabel="y (m)", title="The track from above")
    axes.grid(alpha=0.3)


def draw_heading(axes: Axes, pose: Pose, color: str, **size: float) -> None:
    """Draw an arrow at the pose."""
    axes.quiver(pose.x, pose.y, math.cos(pose.yaw), math.sin(pose.yaw), color=color, zorder=3, pivot="mid",
                headlength=4, headaxislength=4, **size)


def draw_speed(axes: Axes, recording: Recording, speed: Callable[[Twist], float], label: str) -> None:
    """Draw the speed that a function takes from a Twist, commanded and actual, over the time of the odometry."""
    (start, _), (end, _) = recording.velocities[0], recording.velocities[-1]
    commands = [(time, twist) for time, twist in recording.commands if start <= time <= end]
    for samples, style in (commands, COMMANDED), (recording.velocities, ACTUAL):
        axes.plot([time - start for time, _ in samples], [speed(twist) for _, twist in samples], **style)
    axes.set_ylabel(label)
    axes.margins(x=0.01, y=0.15)
    axes.grid(alpha=0.3)
