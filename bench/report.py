"""What was measured, as tables and as a picture."""

import math
import os
import platform
import re
import subprocess
from pathlib import Path
from statistics import median

WIRE = "On the wire, for a command on average"
NODE = "A node on a bus of {} kHz"
ROBOTS = "Robots under one master, 10 commands a second each, buses of 100 kHz"
COLORS = {"this driver": "tab:blue", "workshop's script": "tab:orange", "floor": "tab:gray"}  # by contestant

PAGE = """# How fast it is

Measured by `bench/run` on {machine}; medians of {runs} run(s).

- **this driver**: `jetbot_controller.launch` as it comes.
- **workshop's script**: the script of the workshop on Adafruit_MotorHAT, called as the JetBot library calls it
  (`baseline.py`).
- **floor**: the least that a node of rospy can do: take the newest command, write one block of six bytes (`floor.py`).
  It drives no robot, so it can need more bits: it writes each command, also one that changes nothing.

All get the same commands, on the same fake chip. A transfer is a start, a stop, and nine bits a byte, those of address
and register included. "Last bit" is when the chip's registers, looked at from outside, first hold all of a command;
commands that newer ones overtook do not count. On this fake bus, a transfer of 29 bits took {pace:.2f} ms, on a wire of
100 kHz it takes 0.29 ms. Besides, two to four times a second, this driver checks that the chip still holds what it was
told: {check[0]} transfers, {check[1]} bits.

p50: half of all commands took less; p99: 99 of 100 did.
"""


class Figures(dict):
    """section: {(quantity, case): {contestant: [a value a run]}}."""

    def add(self, section, contestant, quantity, case, value):
        self.setdefault(section, {}).setdefault((quantity, case), {}).setdefault(contestant, []).append(value)

    def medians(self, section):
        """(quantity, case): {contestant: median}, by quantity."""
        rows = self[section]
        quantities = list(dict.fromkeys(quantity for quantity, _ in rows))
        return {row: {name: median(values) for name, values in rows[row].items()}
                for row in sorted(rows, key=lambda row: quantities.index(row[0]))}


def text(figures, failures, runs, check, pace):
    """The Markdown of results.md. failures: what is missing; check, pace: by wire.cost_of_check and wire.pace."""
    sections = [f"\n## {section}\n\n{table(figures.medians(section))}" for section in figures]
    missing = [f"\nLeft out of one run: {failure}.\n" for failure in failures]
    return PAGE.format(machine=machine(), runs=runs, check=check, pace=pace) + "".join(missing + sections)


def table(medians):
    """A Markdown table: a column a contestant, and how many times as much the script, and this driver, take."""
    lines = [["", "", *COLORS, "script : driver", "driver : floor"], ["---", "---", *["---:"] * 5]]
    for (quantity, case), values in medians.items():
        ours, baseline, floor = (values.get(name, math.nan) for name in COLORS)
        lines.append([quantity, case, *map(number, (ours, baseline, floor)), ratio(baseline, ours), ratio(ours, floor)])
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def number(value):
    """Three digits, and no exponent."""
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"


def ratio(value, other):
    return number(value / other) if other else ""


def machine():
    """The computer and its software, in a line."""
    model = re.search(r"^(?:model name|Model)\s*: (.+)", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    ros = subprocess.run(["rosversion", "rospy"], stdout=subprocess.PIPE, text=True, check=True).stdout.strip()
    return (f"{model[1] if model else platform.machine()}, {os.cpu_count()} cores, Linux {platform.release()}, "
            f"Python {platform.python_version()}, rospy {ros}")


def draw(figures, file):
    """Four groups of bars, in a PNG file."""
    from matplotlib.figure import Figure  # here, since the tables do without it
    figure = Figure(figsize=(11, 7.5), constrained_layout=True)
    (wire, stop), (latency, cpu) = figure.subplots(2, 2)
    one = figures.medians(NODE.format(100))
    bars(wire, figures.medians(WIRE), "bits")
    bars(stop, one, "to obey a stop")
    bars(latency, one, "publish to last bit, p99", alpha=0.3)
    bars(latency, one, "publish to last bit, p50")
    bars(cpu, one, "CPU")
    wire.legend(frameon=False)
    wire.set_title("bits on the wire for a command")
    latency.set_title("publish to last bit, p50 and (pale) p99 (ms)")
    for axes in stop, latency:
        axes.set_yscale("log")
        axes.set_ylabel("each line is ten times the one below")
        axes.set_ylim(bottom=0.5)
    figure.savefig(file, dpi=90)


def bars(axes, medians, quantity, **style):
    """A group of bars a case, a bar a contestant."""
    rows = [row for row in medians if row[0].startswith(quantity)]
    for place, (name, color) in enumerate(COLORS.items()):
        heights = [medians[row].get(name, math.nan) for row in rows]
        drawn = axes.bar([group + 0.27 * (place - 1) for group in range(len(rows))], heights, 0.25,
                         color=color, label=name, **style)
        axes.bar_label(drawn, map(number, heights), fontsize=8)
    axes.set_title(rows[0][0])
    axes.set_xticks(range(len(rows)), [case for _, case in rows])
    axes.spines[["top", "right"]].set_visible(False)
