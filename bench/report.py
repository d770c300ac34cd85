"""The measured figures as tables."""

import math
import os
import platform
import re
import subprocess
from pathlib import Path
from statistics import median
from typing import Dict, Sequence, Tuple

from wire import IMPLEMENTATIONS

WIRE = "What is written, on average"
NODE = "One robot"
ROBOTS = "Robots under one master, 10 commands per second each"
RATIOS = ("script", "driver"), ("driver", "floor")

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
    names = [name for name in IMPLEMENTATIONS if any(name in values for values in medians.values())]
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
