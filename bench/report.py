"""The measured figures as tables and as a picture."""

import math
import os
import platform
import re
import subprocess
from pathlib import Path
from statistics import median
from typing import Dict, Sequence, Tuple

WIRE = "What is written, on average"
NODE = "One robot"
ROBOTS = "Robots under one master, 10 commands per second each"
COLORS = {"driver": "tab:blue", "script": "tab:orange", "floor": "tab:gray"}  # by implementation
RATIOS = ("script", "driver"), ("driver", "floor")
PANELS = (  # of the picture: section, the beginning of the quantity, scale
    (WIRE, "bits", "linear"), (NODE, "to obey a stop", "log"), (NODE, "CPU, node", "linear"),
    (NODE, "publish to last bit, p50", "log"), (NODE, "publish to last bit, p99", "log"),
    (NODE, "software's share, p99", "log"))

PAGE = """# How fast it is

Measured by `bench/run` on {machine}; medians of {runs} run(s); buses of {khz:g} kHz.

- **driver**: `jetbot_controller.launch` with its defaults.
- **script**: the workshop's script on Adafruit_MotorHAT, called as the JetBot library calls it (`script.py`).
- **floor**: a bare rospy subscriber that writes one block of six bytes for every command (`floor.py`).

All get the same commands on the same fake chip. A transfer is a start, a stop and nine bits per byte, address and
register included; a command's bits are those of its writes. *Publish to last bit*: until the chip's registers, polled
from outside, hold all of a command; commands that newer ones overtook do not count. *Software's share*: that time less
the wire time of the command's own writes; what the fake bus itself takes counts to it. *p50*: half of all commands took
less; *p99*: 99 of 100 did. *Idle*: the robot is stopped and nobody publishes.
"""


class Figures(dict):
    """section: {(quantity, case): {implementation: [one value per run]}}."""

    def add(self, section: str, implementation: str, quantity: str, case: str, value: float) -> None:
        """Add the value of one run."""
        self.setdefault(section, {}).setdefault((quantity, case), {}).setdefault(implementation, []).append(value)

    def medians(self, section: str) -> Dict[Tuple[str, str], Dict[str, float]]:
        """Return (quantity, case): {implementation: median}, grouped by quantity."""
        rows = self[section]
        quantities = list(dict.fromkeys(quantity for quantity, _ in rows))
        return {row: {name: median(values) for name, values in rows[row].items()}
                for row in sorted(rows, key=lambda row: quantities.index(row[0]))}


def text(figures: Figures, failures: Sequence, plan) -> str:
    """Return the Markdown of results.md."""
    page = PAGE.format(machine=machine(), runs=plan.runs, khz=plan.clock / 1000)
    missing = [f"\nLeft out of one run: {failure}.\n" for failure in failures]
    return "".join([page, *missing, *(f"\n## {name}\n\n{table(figures.medians(name))}" for name in figures)])


def table(medians: Dict[Tuple[str, str], Dict[str, float]]) -> str:
    """Return a Markdown table: a column per implementation and per ratio of two of them."""
    names = [name for name in COLORS if any(name in values for values in medians.values())]
    ratios = [pair for pair in RATIOS if set(pair) <= set(names)]
    lines = [["", "", *names, *map(" : ".join, ratios)], ["---", "---", *["---:"] * len([*names, *ratios])]]
    for (quantity, case), values in medians.items():
        row = {name: values.get(name, math.nan) for name in names}
        lines.append([quantity, case, *map(number, row.values()),
                      *(number(row[a] / row[b]) if row[b] else "" for a, b in ratios)])
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def number(value: float) -> str:
    """Return three digits without an exponent."""
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"


def machine() -> str:
    """Return the computer and its software in one line."""
    model = re.search(r"^(?:model name|Model)\s*: (.+)", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    ros = subprocess.run(["rosversion", "rospy"], stdout=subprocess.PIPE, text=True, check=True).stdout.strip()
    return (f"{model[1] if model else platform.machine()}, {os.cpu_count()} cores, Linux {platform.release()}, "
            f"Python {platform.python_version()}, rospy {ros}")


def draw(figures: Figures, file: Path) -> None:
    """Draw the panels into a PNG file: a group of bars per case, a bar per implementation."""
    from matplotlib.figure import Figure  # here: the tables, and their tests, do without it
    figure = Figure(figsize=(14, 7.5), constrained_layout=True)
    for axes, (section, quantity, scale) in zip(figure.subplots(2, 3).flat, PANELS):
        rows = {row: values for row, values in figures.medians(section).items() if row[0].startswith(quantity)}
        for place, (name, color) in enumerate(COLORS.items()):
            heights = [values.get(name, math.nan) for values in rows.values()]
            bars = axes.bar([group + 0.27 * (place - 1) for group in range(len(rows))], heights, 0.25, color=color,
                            label=name)
            axes.bar_label(bars, map(number, heights), fontsize=8)
        axes.set(title=list(rows)[0][0], yscale=scale)
        axes.set_ylim(0.1 if scale == "log" else 0, 1.3 * axes.get_ylim()[1])
        axes.set_xticks(range(len(rows)), [case for _, case in rows])
    figure.axes[0].legend(frameon=False)
    figure.savefig(file, dpi=90)
