"""A picture of a recording: the track from above, and the speeds over time."""

import math

from matplotlib.figure import Figure

from .recording import Recording

ACTUAL, COMMANDED, START, END = "tab:blue", "tab:orange", "tab:green", "tab:red"
ARROWS = 8  # along the track


def draw(recording: Recording, file: str) -> None:
    """Draw a recording with at least one sample into a PNG file; raise OSError where it cannot be written."""
    figure = Figure(figsize=(7, 9), constrained_layout=True)
    track, linear, angular = figure.subplots(3, gridspec_kw={"height_ratios": (5, 1.2, 1.2)})
    draw_track(track, recording.samples)
    draw_speed(linear, recording, "linear", "speed (m/s)")
    draw_speed(angular, recording, "angular", "turn (rad/s)")
    linear.tick_params(labelbottom=False)
    linear.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncol=2, frameon=False)
    angular.set_xlabel("time (s)")
    figure.align_ylabels()
    figure.savefig(file, dpi=100)


def draw_track(axes, samples):
    """Draw the track from above, with arrows in the direction of the heading."""
    axes.plot([sample.x for sample in samples], [sample.y for sample in samples], color=ACTUAL, linewidth=2)
    for sample in samples[::max(1, len(samples) // ARROWS)]:
        draw_heading(axes, sample, ACTUAL)
    draw_heading(axes, samples[0], START, "start")
    draw_heading(axes, samples[-1], END, "end")
    axes.set_aspect("equal", "datalim")
    axes.margins(0.1)
    axes.set(xlabel="x (m)", ylabel="y (m)", title="The track from above")
    axes.grid(alpha=0.3)


def draw_heading(axes, sample, color, label=None):
    """Draw an arrow; one with a label is larger and appears in the legend."""
    axes.quiver(sample.x, sample.y, math.cos(sample.yaw), math.sin(sample.yaw), color=color, zorder=3,
                pivot="mid", scale=22 if label else 40, width=0.011 if label else 0.006, headlength=4, headaxislength=4)
    if label:
        axes.plot([], [], marker=(3, 0, -90), markersize=11, linestyle="", color=color,
                  label=f"{label}: x {sample.x:.2f} m, y {sample.y:.2f} m, heading {math.degrees(sample.yaw):.0f}°")
        axes.legend(loc="upper left")


def draw_speed(axes, recording, name, label):
    """Draw one speed, "linear" or "angular", as commanded and as driven, from the first sample to the last."""
    start, end = recording.samples[0].time, recording.samples[-1].time

    def plot(rows, **style):
        axes.plot([row.time - start for row in rows], [getattr(row, name) for row in rows], **style)

    plot([command for command in recording.commands if start <= command.time <= end], drawstyle="steps-post",
         label="commanded", color=COMMANDED, linewidth=4, alpha=0.6)
    plot(recording.samples, label="actual", color=ACTUAL, linewidth=1.5)
    axes.set_ylabel(label)
    axes.margins(x=0.01, y=0.15)
    axes.grid(alpha=0.3)
