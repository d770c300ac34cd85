#!/usr/bin/env python3
"""Measures this driver, the workshop's script on Adafruit's library, and a bare rospy subscriber, side by side."""

import argparse
import signal
import sys
import time
from collections import namedtuple
from functools import partial
from itertools import product
from pathlib import Path
from statistics import mean
from typing import Iterator, List, Sequence, Tuple

import node
import numpy
import report
import wire

ROBOTS_RATE = 10  # commands per second
PARTS = "wire", "node", "robots"

Rows = Iterator[Tuple[str, str, float]]  # quantity, case, value
# rates, floods: commands per second; clock: of the buses, in Hz
Plan = namedtuple("Plan", "runs rates seconds floods flood_seconds idle_seconds robots clock")
FULL = Plan(3, (10, 100, 200), 10, (500, 1000), 5, 10, (1, 10, 30), 100_000)
SHORT = Plan(1, (50,), 1, (500,), 0.5, 2, (3,), 100_000)

progress = partial(print, "bench:", file=sys.stderr, flush=True)


def measure_wire(plan: Plan, implementation: str) -> Rows:
    """Measure the writes for a command, on average; the first command does not count."""
    for case, speeds in wire.SPEEDS.items():
        commands = wire.replay(implementation, speeds)[1:]
        yield "transfers per command", case, mean(len(command.writes) for command in commands)
        yield "bits per command", case, mean(sum(command.writes) for command in commands)


def measure_node(plan: Plan, implementation: str) -> Rows:
    """Measure one robot."""
    with node.running(implementation, 1, plan.clock) as robots:
        for rate in plan.rates:
            yield from measure_drive(plan, robots, rate, f"{rate} Hz")
        for rate in plan.floods:
            latencies, *_ = robots.drive([*wire.cruise(int(rate * plan.flood_seconds)), (0, 0)], rate)
            yield f"to obey a stop after a flood of {plan.flood_seconds} s (ms)", f"{rate} Hz", latencies[-1]
        yield from cpu_rows("idle", robots.cpu_during(lambda: time.sleep(plan.idle_seconds)))
        reads = node.transfer_rate(plan.idle_seconds) if implementation == "driver" else 0  # the others read nothing
        yield "read back to verify the chip (transfers per second)", "idle", reads
        for process, memory in zip(("node", "guard"), robots.memory()):
            yield "memory (MiB)", process, memory
        yield "roslaunch to subscribed (s)", "", robots.startup


def measure_robots(plan: Plan, implementation: str, count: int) -> Rows:
    """Measure several robots, commanded one after the other."""
    with node.running(implementation, count, plan.clock) as robots:
        yield from measure_drive(plan, robots, ROBOTS_RATE, f"robots: {count}")
        yield "roslaunch to all subscribed (s)", f"robots: {count}", robots.startup


def measure_drive(plan: Plan, robots: node.Robots, rate: int, case: str) -> Rows:
    """Measure latency and CPU at ``rate`` commands per second for each robot."""
    latencies, software, cpu = robots.drive(wire.cruise(int(rate * plan.seconds)), rate)
    for quantity, values in ("publish to last bit", latencies), ("software's share", software):
        for percent in 50, 99:
            yield f"{quantity}, p{percent} (ms)", case, numpy.percentile(values, percent)
    yield from cpu_rows(case, cpu)


def cpu_rows(case: str, cpu: Sequence[float]) -> Rows:
    """Return what ``Robots.cpu_during`` returned as rows."""
    yield "CPU, node and guard (% of a core)", case, sum(cpu)
    yield "CPU, guard alone (% of a core)", case, cpu[1]


def measure(plan: Plan, implementations: Sequence[str],
            parts: Sequence[str]) -> Tuple[report.Figures, List[node.Failure]]:
    """Return the figures and what failed; the implementations take turns, so that other load affects all alike."""
    robots = [("robots", report.ROBOTS, partial(measure_robots, count=count)) for count in plan.robots]
    jobs = [("wire", report.WIRE, measure_wire), *plan.runs * [("node", report.NODE, measure_node), *robots]]
    jobs = [job for part, *job in jobs if part in parts]
    figures, failures = report.Figures(), []
    with node.master():
        for (number, (section, job)), name in product(enumerate(jobs, 1), implementations):
            progress(f"{number} of {len(jobs)}: {section}: {name}")
            try:
                for row in job(plan, name):
                    figures.add(section, name, *row)
            except node.Failure as failure:
                progress(f"left out: {failure}")
                failures.append(failure)
    return figures, failures


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="bench/run", description=f"{__doc__} Writes results.md.")
    parser.add_argument("--runs", type=int, help="how many runs the medians are of; 3, or 1 with --short")
    parser.add_argument("--short", action="store_true", help="measure less, to check that it works: a minute")
    parser.add_argument("--only", nargs="+", choices=wire.IMPLEMENTATIONS, default=wire.IMPLEMENTATIONS,
                        help="driver and floor take four minutes per run")
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=PARTS, help="what to measure; everything")
    parser.add_argument("--clock", type=int, default=FULL.clock, help="of the buses, in Hz; 100000")
    parser.add_argument("--output", type=Path, default=Path(__file__).parent, help="the folder for the results")
    return parser.parse_args()


def main() -> int:
    given = parse_arguments()
    plan = SHORT if given.short else FULL
    plan = plan._replace(clock=given.clock, runs=given.runs or plan.runs)
    for signum in signal.SIGINT, signal.SIGTERM, signal.SIGHUP:
        signal.signal(signum, lambda *_: sys.exit(1))
    Path("/proc/self/timerslack_ns").write_text("1")  # the fake bus sleeps for each bit: let it be exact, for all alike
    figures, failures = measure(plan, given.only, given.parts)
    given.output.mkdir(parents=True, exist_ok=True)
    (given.output / "results.md").write_text(report.text(figures, failures, plan))
    progress(f"wrote {given.output}/results.md")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
