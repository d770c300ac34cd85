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
import threading
import time
from pathlib import Path
from statistics import median
from typing import List, Sequence

ROOT = Path(__file__).resolve().parents[1]
sys.path += [str(ROOT / "tests"), str(ROOT / "tests/ros")]

from browser.page import Page  # noqa: E402
from browser.world import World  # noqa: E402
from cockpit_class import SchoolClass  # noqa: E402

from jetbot.wait import wait_until  # noqa: E402

ROBOT, MOVES, STOPS = "jetbot_01", 200, 10
POLL_INTERVAL = 0.0005  # s
# Keeps the times, in s since the epoch, at which the page sends a command.
KEEP_TIMES = """window.times = []; const send = WebSocket.prototype.send;
    WebSocket.prototype.send = function (text) {
        if (JSON.parse(text).type === "drive") window.times.push((performance.timeOrigin + performance.now()) / 1000);
        send.call(this, text);
    };"""


def row(what: str, milliseconds: Sequence[float]) -> str:
    """Return a row of a table in Markdown: median, 99th percentile, number of samples."""
    ordered = sorted(milliseconds)
    return f"| {what} | {median(ordered):.1f} | {ordered[int(0.99 * (len(ordered) - 1))]:.1f} | {len(ordered)} |"


def page_latencies(folder: Path) -> List[float]:
    """Return the ms from when a page sends a new command until the chip holds it."""
    folder.mkdir()
    world, page = World(folder, ROBOT), Page(folder / "profile")
    try:
        page.open(world.address, ROBOT)
        page.run(KEEP_TIMES)
        world.drive(page, ROBOT)
        return [latency_of_a_move(world, page, 0.5 + 0.4 * (number % 2)) for number in range(MOVES)]
    finally:
        page.close()
        world.close()


def latency_of_a_move(world: World, page: Page, forward: float) -> float:
    """Move the finger; return the ms from the last command that was sent before the chip changed."""
    time.sleep(random.uniform(0.1, 0.2))
    before, changed = world.wheels(ROBOT), []

    def watch():
        wait_until(lambda: world.wheels(ROBOT) != before, 5.0, POLL_INTERVAL)
        changed.append(time.time())

    watcher = threading.Thread(target=watch)
    watcher.start()
    page.move(forward, 0.0)
    watcher.join()
    return 1000 * (changed[0] - max(sent for sent in page.run("return window.times") if sent < changed[0]))


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
    with tempfile.TemporaryDirectory(prefix="jetbot_") as home:
        print("| | median | 99 % | samples |\n|---|---|---|---|")
        print(row("1 page: the page sends, the chip changes (ms)", page_latencies(Path(home, "page"))))
        measure_class(Path(home, "class"), options.robots, options.seconds)


if __name__ == "__main__":
    main()
