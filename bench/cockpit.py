#!/usr/bin/env python3
"""Measures the cockpit: how soon the wheels get what one page sends, and how a class of simulated robots drives.

./morbot shell python3 bench/cockpit.py [--robots 15] [--seconds 30]

Takes about two minutes, and needs chromium and python3-selenium. What the robots get is read from the chips on their
fake buses. The clients of the class send 20 commands per second each, every one with a new speed.
"""

import argparse
import random
import sys
import tempfile
import time
from contextlib import closing
from pathlib import Path
from statistics import median
from typing import List, Optional, Sequence

ROOT = Path(__file__).resolve().parents[1]
sys.path += [str(ROOT / "tests"), str(ROOT / "tests/ros")]

from browser.page import Page  # noqa: E402
from browser.world import World  # noqa: E402
from cockpit_class import SchoolClass  # noqa: E402

from jetbot.fake.motors import STOPPED  # noqa: E402
from jetbot.wait import wait_until  # noqa: E402
from processes import end_on_sigterm  # noqa: E402

ROBOT, MOVES, STOPS = "jetbot_01", 200, 10
MOVE_TIMEOUT = 1.0  # s until a command is in the chip
MISSED = 10  # moves at most, because the dead man's switch stopped the robot of a page that paused


def row(what: str, milliseconds: Sequence[float]) -> str:
    """Return a row of a table in Markdown: median, 99th percentile, number of samples."""
    ordered = sorted(milliseconds)
    return f"| {what} | {median(ordered):.1f} | {ordered[int(0.99 * (len(ordered) - 1))]:.1f} | {len(ordered)} |"


def page_latencies(folder: Path) -> List[float]:
    """Return the ms from when a page sends a new command until the chip holds it."""
    folder.mkdir()
    with closing(World(folder, ROBOT)) as world, closing(Page(folder / "profile")) as page:
        page.open(world.address, ROBOT)
        world.drive(page, ROBOT)
        latencies, missed = [], 0
        while len(latencies) < MOVES:
            latency = latency_of_a_move(world, page, 0.5 + 0.4 * (len(latencies) % 2))
            latencies += [] if latency is None else [latency]
            missed += latency is None
            if missed > MISSED:
                raise RuntimeError(f"the robot does not obey the page, which shows {page.text_of('body')!r}")
    return latencies


def latency_of_a_move(world: World, page: Page, forward: float) -> Optional[float]:
    """Move the finger; return the ms from the last command that was sent before the chip changed.

    None: it did not change. Then the finger is put on the pad again.
    """
    time.sleep(random.uniform(0.1, 0.2))
    start = time.time()
    page.move(forward, 0.0)
    if world.wheels(ROBOT) == STOPPED or not wait_until(lambda: world.record.since(ROBOT, start), MOVE_TIMEOUT):
        world.drive(page, ROBOT)
        return None
    changed = world.record.since(ROBOT, start)[0].time
    return 1000 * (changed - max(command.time for command in page.sent() if command.time < changed))


def measure_class(folder: Path, robots: int, seconds: float) -> None:
    """Print the figures of a class."""
    folder.mkdir()
    with SchoolClass(folder, robots) as school_class:
        figures = school_class.drive(seconds)
        print(row(f"{robots} clients: a client sends, the chip changes (ms)", figures.latencies))
        print(row(f"{robots} clients: stop to all wheels (ms)", [school_class.stop() for _ in range(STOPS)]))
    print(f"\nWithin {seconds:.0f} s: wheels at zero while driven: {figures.stops}, `lift` messages: {figures.lifts}, "
          f"closed sockets: {figures.closed}.\nNew poses of the own robot per second and client: at least "
          f"{figures.map_rate:.1f}.\n\n| process | number | CPU each (%) |\n|---|---|---|")
    for kind, (number, percent) in sorted(figures.cpu.items()):
        print(f"| {kind} | {number} | {percent:.1f} |")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", type=int, default=15)
    parser.add_argument("--seconds", type=float, default=30.0)
    options = parser.parse_args()
    end_on_sigterm()
    with tempfile.TemporaryDirectory(prefix="jetbot_") as home:
        print("| | median | 99 % | samples |\n|---|---|---|---|")
        print(row("1 page: the page sends, the chip changes (ms)", page_latencies(Path(home, "page"))))
        measure_class(Path(home, "class"), options.robots, options.seconds)


if __name__ == "__main__":
    main()
