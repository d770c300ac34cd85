"""A picture of a recording: the track from above, and the speeds over time."""

import math

from matplotlib.figure import Figure

from .recording import Recording

ACTUAL, COMMANDED, START, END = "tab:blue", "tab:orange", "tab:green", "tab:red"
ARROWS = 8  # along the track


def draw(recording: Recording, file: str) -> None:
    """Draw a recording that holds odometry into a PNG file; raise OSError where it cannot be written."""
    figure = Figure(figsize=(7, 9), constrained_layout=True)
    track, linear, angular = figure.subplots(3, gridspec_kw={"height_ratios": (5, 1.2, 1.2)})
    draw_track(track, [sample.pose for sample in recording.odometry])
    draw_speed(linear, recording, "linear", "speed (m/s)")
    draw_speed(angular, recording, "angular", "turn (rad/s)")
    linear.tick_params(labelbottom=False)
    linear.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncol=2, frameon=False)
    angular.set_xlabel("time (s)")
    figure.align_ylabels()
    figure.savefig(file, dpi=100)


def draw_track(axes, poses):
    """Draw the track from above, with arrows in the direction of the heading."""
    axes.plot([pose.x for pose in poses], [pose.y for pose in poses], color=ACTUAL, linewidth=2)
    for pose in poses[::max(1, len(poses) // ARROWS)]:
        draw_heading(axes, pose, ACTUAL)
    draw_heading(axes, poses[0], START, "start")
    draw_heading(axes, poses[-1], END, "end")
    axes.legend(loc="upper left")
    axes.set_aspect("equal", "datalim")
    axes.margins(0.1)
    axes.set(xlabel="x (m)", ylabel="y (m)", title="The track from above")
    axes.grid(alpha=0.3)


def draw_heading(axes, pose, color, label=None):
    """Draw an arrow; one with a label is larger and appears in the legend."""
    axes.quiver(pose.x, pose.y, math.cos(pose.yaw), math.sin(pose.yaw), color=color, zorder=3, pivot="mid",
                scale=22 if label else 40, width=0.011 if label else 0.006, headlength=4, headaxislength=4)
    if label:
        axes.plot([], [], marker=(3, 0, -90), markersize=11, linestyle="", color=color,
                  label=f"{label}: x {pose.x:.2f} m, y {pose.y:.2f} m, heading {math.degrees(pose.yaw):.0f}°")


def draw_speed(axes, recording, name, label):
    """Draw one speed, "linear" or "angular", as commanded and as driven, over the time of the odometry."""
    start, end = recording.odometry[0].time, recording.odometry[-1].time

    def plot(samples, **style):
        axes.plot([sample.time - start for sample in samples], [getattr(sample, name) for sample in samples], **style)

    plot([command for command in recording.commands if start <= command.time <= end], drawstyle="steps-post",
         label="commanded", color=COMMANDED, linewidth=4, alpha=0.6)
    plot(recording.odometry, label="actual", color=ACTUAL, linewidth=1.5)
    axes.set_ylabel(label)
    axes.margins(x=0.01, y=0.15)
    axes.grid(alpha=0.3)
