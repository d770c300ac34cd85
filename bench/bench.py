#!/usr/bin/env python3
"""Measures this driver, the workshop's script on Adafruit's library, and the least that a node can do, side by side."""

import argparse
import signal
import sys
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import node
import numpy
import report
import wire

CLOCKS = 100_000, 400_000  # Hz
STOP = 0.0, 0.0
ROBOTS_RATE = 10           # commands a second
# clocks in Hz; rates and floods in commands a second; seconds and the least number of commands at each rate
FULL = {"runs": 3, "clocks": CLOCKS, "rates": (10, 50, 100, 200), "seconds": 5, "least": 100,
        "floods": (500, 1000), "flood_seconds": 5, "robots": (1, 10, 30)}
SHORT = {"runs": 1, "clocks": CLOCKS[:1], "rates": (50,), "seconds": 1, "least": 0,
         "floods": (500,), "flood_seconds": 0.5, "robots": (3,)}


def measure_wire(add, plan, contestant):
    """What crosses the wire for a command, on average."""
    for case, speeds in wire.SPEEDS.items():
        transfers, bits = wire.cost(contestant, speeds)
        add("transfers", case, transfers)
        add("bits", case, bits)
        for clock in CLOCKS:
            add(f"ms at {clock // 1000} kHz", case, 1000 * bits / clock)


def measure_node(add, plan, contestant, clock):
    """One robot."""
    with node.running(contestant, 1, clock) as robots:
        for rate in plan.rates:
            measure_drive(add, plan, robots, rate, f"{rate} Hz")
        for rate in plan.floods:
            latencies, _ = robots.drive([*wire.cruise(int(rate * plan.flood_seconds)), STOP], rate)
            add(f"to obey a stop after a flood of {plan.flood_seconds} s (ms)", f"{rate} Hz", latencies[-1])
        add("memory (MiB)", "node", robots.memory(children=False))
        add("memory (MiB)", "node and guard", robots.memory(children=True))
        add("roslaunch to subscribed (s)", "", robots.startup)


def measure_robots(add, plan, contestant, count):
    """Several robots, commanded one after the other."""
    with node.running(contestant, count, CLOCKS[0]) as robots:
        measure_drive(add, plan, robots, ROBOTS_RATE, f"robots: {count}")
        add("roslaunch to all subscribed (s)", f"robots: {count}", robots.startup)


def measure_drive(add, plan, robots, rate, case):
    latencies, cpu = robots.drive(wire.cruise(max(int(rate * plan.seconds), plan.least)), rate)
    for percent in 50, 99:
        add(f"publish to last bit, p{percent} (ms)", case, numpy.percentile(latencies, percent))
    add("CPU, each (% of a core)", case, cpu)


def measure(plan):
    """The report.Figures, and what failed; contestants take turns, so that what else runs here meets all alike."""
    jobs = [*((report.NODE.format(clock // 1000), partial(measure_node, clock=clock)) for clock in plan.clocks),
            *((report.ROBOTS, partial(measure_robots, count=count)) for count in plan.robots)]
    jobs = [(report.WIRE, measure_wire), *plan.runs * jobs]
    figures, failures = report.Figures(), []
    with node.master():
        for number, (section, job) in enumerate(jobs, 1):
            for contestant in wire.CONTESTANTS:
                progress(f"{number} of {len(jobs)}: {section}: {contestant}")
                try:
                    job(partial(figures.add, section, contestant), plan, contestant)
                except node.Failure as failure:
                    progress(f"left out: {failure}")
                    failures.append(failure)
    return figures, failures


def progress(text):
    print(f"bench: {text}", file=sys.stderr, flush=True)


def arguments():
    parser = argparse.ArgumentParser(prog="bench/run", description=f"{__doc__} Writes results.md and results.png.")
    parser.add_argument("--runs", type=int, help="the results are the medians of so many; 3 unless --short")
    parser.add_argument("--short", action="store_true", help="less of everything, to see that it works: a minute")
    parser.add_argument("--output", type=Path, default=Path(__file__).parent, help="the folder for the results")
    return parser.parse_args()


def main():
    given = arguments()
    plan = SimpleNamespace(**(SHORT if given.short else FULL))
    plan.runs = given.runs or plan.runs
    for ending in signal.SIGINT, signal.SIGTERM, signal.SIGHUP:
        signal.signal(ending, lambda *_: sys.exit(1))
    Path("/proc/self/timerslack_ns").write_text("1")  # the fake bus sleeps for each bit: let it be exact, for all alike
    figures, failures = measure(plan)
    given.output.mkdir(parents=True, exist_ok=True)
    page = report.text(figures, failures, plan.runs, wire.cost_of_check(), wire.pace())
    (given.output / "results.md").write_text(page)
    report.draw(figures, given.output / "results.png")
    progress(f"wrote {given.output}/results.md and results.png")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
