#!/usr/bin/env python3
"""Measures this driver, the workshop's script on Adafruit's library, and a bare rospy subscriber, side by side."""

import argparse
import os
import platform
import sys
import time
from collections import namedtuple
from itertools import product
from pathlib import Path
from statistics import mean, median, quantiles
from typing import Dict, Iterator, List, Sequence, Tuple

import cockpit
import launched
import wire

from processes import end_on_sigterm

IMPLEMENTATIONS = "driver", "script", "floor"
RATIOS = ("script", "driver"), ("driver", "floor")
ROBOTS_RATE = 10  # commands per second
PAGE = """# How fast it is

Measured by `bench/run` on {cores} cores ({machine}), Linux {linux}, Python {python}; medians of {runs} run(s).

- **driver**: `jetbot_controller.launch` with its defaults.
- **script**: the workshop's script on Adafruit_MotorHAT, called as the JetBot library calls it (`script.py`).
- **floor**: a bare rospy subscriber that writes one block of six bytes for every command (`floor.py`).

All get the same commands on the same fake chip, on a bus of 100 kHz. A transfer is a start, a stop and nine bits per
byte, address and register included; a command's bits are those of its writes. *Software's share*: from publish until
the chip's registers, polled from outside, hold all of a command, less the wire time of its own writes; what the fake
bus itself takes counts to it, and commands that newer ones overtook do not count. *p50*: half of all commands took
less; *p99*: 99 of 100 did. *Idle*: the robot is stopped and nobody publishes.
"""

Rows = Iterator[Tuple[str, str, float]]  # quantity, case, value
Figures = Dict[Tuple[str, str], Dict[str, List[float]]]  # (quantity, case): {implementation: one value per run}
# rates, floods: commands per second
Plan = namedtuple("Plan", "runs rates seconds floods flood_seconds idle_seconds robots clients class_seconds")
FULL = Plan(3, (10, 100, 200), 10, (500, 1000), 5, 10, (1, 10, 30), (1, 15, 30), 30)
SHORT = Plan(1, (50,), 1, (500,), 0.5, 2, (3,), (2,), 2)


def measure_wire(plan: Plan, implementation: str) -> Rows:
    """Measure the writes for a command, on average; the first command does not count."""
    levels = -1, -0.5, 0, 0.5, 1
    for case, speeds in ("new speeds", wire.cruise(300)), ("any two of five speeds", [*product(levels, levels)] * 4):
        commands = wire.replay(implementation, speeds)[1:]
        yield "transfers per command", case, mean(len(command.writes) for command in commands)
        yield "bits per command", case, mean(sum(command.writes) for command in commands)


def measure_node(plan: Plan, implementation: str) -> Rows:
    """Measure one robot."""
    with launched.running(implementation, 1) as robots:
        for rate in plan.rates:
            yield from measure_drive(plan, robots, rate, f"{rate} Hz")
        for rate in plan.floods:
            shares, _ = robots.drive([*wire.cruise(int(rate * plan.flood_seconds)), (0, 0)], rate)
            yield f"stop after a flood of {plan.flood_seconds} s, software's share (ms)", f"{rate} Hz", shares[-1]
        yield "CPU, node and guard (% of a core)", "idle", robots.cpu_during(lambda: time.sleep(plan.idle_seconds))
        yield "roslaunch to subscribed (s)", "", robots.startup


def measure_robots(plan: Plan, implementation: str) -> Rows:
    """Measure several robots, commanded one after the other."""
    for count in plan.robots:
        with launched.running(implementation, count) as robots:
            yield from measure_drive(plan, robots, ROBOTS_RATE, f"robots: {count}")
            yield "roslaunch to all subscribed (s)", f"robots: {count}", robots.startup


def measure_drive(plan: Plan, robots: launched.Robots, rate: int, case: str) -> Rows:
    """Measure software's share and CPU at ``rate`` commands per second for each robot."""
    shares, cpu = robots.drive(wire.cruise(int(rate * plan.seconds)), rate)
    yield from percentiles("software's share", case, shares)
    yield "CPU, node and guard (% of a core)", case, cpu


def measure_class(plan: Plan, implementation: str) -> Rows:
    """Measure a class that drives simulated robots by the cockpit."""
    for count in plan.clients:
        case = f"clients: {count}"
        changes, stops, poses, cpu = cockpit.measure(count, plan.class_seconds)
        yield from percentiles("a client sends, the chip changes", case, [latency for latency, _ in changes])
        yield from percentiles("stop to the last wheel", case, stops)
        yield f"wheels at zero while driven, in {plan.class_seconds} s", case, sum(stopped for _, stopped in changes)
        yield "new poses per second and client, at least", case, poses
        for program, used in sorted(cpu.items()):
            yield f"CPU of each {program} (% of a core)", case, used


def percentiles(quantity: str, case: str, milliseconds: Sequence[float]) -> Rows:
    yield f"{quantity}, p50 (ms)", case, median(milliseconds)
    yield f"{quantity}, p99 (ms)", case, quantiles(milliseconds, n=100, method="inclusive")[98]


MEASUREMENTS = {  # part: (title, function, what it is measured of)
    "wire": ("What is written, on average", measure_wire, IMPLEMENTATIONS),
    "node": ("One robot", measure_node, IMPLEMENTATIONS),
    "robots": (f"Robots under one master, {ROBOTS_RATE} commands per second each", measure_robots, IMPLEMENTATIONS),
    "cockpit": (f"A class drives by the cockpit, {cockpit.RATE} commands per second each", measure_class, ["driver"]),
}


def measure(plan: Plan, only: Sequence[str], parts: Sequence[str], figures: Dict[str, Figures]) -> None:
    """Add to {title: figures}; the implementations take turns, so that other load affects all alike."""
    with launched.master():
        for run, part, name in product(range(1, plan.runs + 1), parts, only):
            title, function, implementations = MEASUREMENTS[part]
            if name not in implementations:
                continue
            print(f"bench: run {run} of {plan.runs}: {title}: {name}", file=sys.stderr, flush=True)
            for quantity, case, value in function(plan, name):
                figures.setdefault(title, {}).setdefault((quantity, case), {}).setdefault(name, []).append(value)


def table(figures: Figures) -> str:
    """Return a Markdown table of the medians: a column per implementation and per ratio of two of them."""
    names = [name for name in IMPLEMENTATIONS if any(name in values for values in figures.values())]
    ratios = [pair for pair in RATIOS if {*pair} <= {*names}]
    lines = [["", "", *names, *map(" : ".join, ratios)], ["---", "---", *["---:"] * len([*names, *ratios])]]
    quantities = list(dict.fromkeys(quantity for quantity, _ in figures))
    for quantity, case in sorted(figures, key=lambda row: quantities.index(row[0])):
        row = {name: median(values) for name, values in figures[quantity, case].items()}
        lines.append([quantity, case, *(number(row[name]) if name in row else "" for name in names),
                      *(number(row[a] / row[b]) if a in row and row.get(b) else "" for a, b in ratios)])
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def number(value: float) -> str:
    """Return three digits without an exponent."""
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"


def page(figures: Dict[str, Figures], runs: int) -> str:
    """Return the Markdown of results.md."""
    text = PAGE.format(cores=os.cpu_count(), machine=platform.machine(), linux=platform.release(),
                       python=platform.python_version(), runs=runs)
    return "".join([text, *(f"\n## {title}\n\n{table(rows)}" for title, rows in figures.items())])


def main() -> None:
    parser = argparse.ArgumentParser(prog="bench/run", description=f"{__doc__} Writes results.md.")
    parser.add_argument("--runs", type=int, help="how many runs the medians are of; 3, or 1 with --short")
    parser.add_argument("--short", action="store_true", help="measure less, to check that it works: a minute")
    parser.add_argument("--only", nargs="+", choices=IMPLEMENTATIONS, default=IMPLEMENTATIONS,
                        help="driver and floor take four minutes per run")
    parser.add_argument("--parts", nargs="+", choices=MEASUREMENTS, default=MEASUREMENTS, help="everything by default")
    parser.add_argument("--output", type=Path, default=Path(__file__).parent, help="the folder for the results")
    given = parser.parse_args()
    plan = SHORT if given.short else FULL
    plan = plan._replace(runs=given.runs or plan.runs)
    end_on_sigterm()
    Path("/proc/self/timerslack_ns").write_text("1")  # the fake bus sleeps for each bit: let it be exact, for all alike
    figures: Dict[str, Figures] = {}
    try:
        measure(plan, given.only, given.parts, figures)
    finally:
        given.output.mkdir(parents=True, exist_ok=True)
        (given.output / "results.md").write_text(page(figures, plan.runs))
    print(f"bench: wrote {given.output}/results.md", file=sys.stderr)


if __name__ == "__main__":
    main()
