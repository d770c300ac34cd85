#!/usr/bin/env python3
"""Measures how a class drives by the cockpit: class.launch, and for each simulated robot a client that drives it.

./morbot shell python3 bench/cockpit.py [--robots 15] [--seconds 30]

Each client sends 20 commands per second, every one with a new speed. What a robot gets is read from its fake bus.
"""

import argparse
import asyncio
import json
import mmap
import os
import re
import sys
import tempfile
import threading
import time
from collections import Counter
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from typing import Dict, Iterator, List, Sequence, Tuple

from tornado.httpclient import HTTPRequest
from tornado.websocket import websocket_connect

sys.path.append(str(Path(__file__).resolve().parents[1] / "tests/ros"))
from jetbot.fake import chip_file, default_folder  # noqa: E402
from jetbot.fake.motors import STOPPED, wheel_speeds  # noqa: E402
from processes import end, end_on_sigterm, free_port, start  # noqa: E402

RATE, STOPS = 20, 10  # commands per second of each client; how often all are stopped
START_TIMEOUT = 180.0  # s
POLL_INTERVAL = 0.002  # s
OUTPUTS = slice(0x06, 0x46)  # the chip's registers of all outputs
TICKS = os.sysconf("SC_CLK_TCK")  # of CPU time per second
PROGRAM = re.compile(r"jetbot\.guard|\w+(?=\.py\b)|rosmaster")


class Client:
    """Drives one robot, and counts what the cockpit sends. name: of the robot."""

    def __init__(self, name: str):
        self.name, self.folder = name, default_folder(name)
        self.sent, self.received, self.pose = 0.0, Counter(), None

    async def join(self, host: str) -> None:
        """Connect, once the cockpit listens, and drive until the wheels turn."""
        request = HTTPRequest(f"ws://{host}/socket", headers={"Origin": f"http://{host}"})
        self.socket = None
        while not self.socket:
            try:
                self.socket = await websocket_connect(request)
            except OSError:
                await asyncio.sleep(0.5)
        self.listener = asyncio.ensure_future(self._listen())
        turned = False
        while not turned:
            await self.drive(0.5)
            turned = wheel_speeds(self.folder) != STOPPED
            await self.release()
            await asyncio.sleep(1.0)
        with chip_file(self.folder, 0x60).open("rb") as chip:
            self.chip = mmap.mmap(chip.fileno(), 0, prot=mmap.PROT_READ)

    async def drive(self, seconds: float) -> None:
        start = time.monotonic()
        for tick in range(round(seconds * RATE)):
            await asyncio.sleep(start + tick / RATE - time.monotonic())
            self.sent = time.monotonic()
            await self.send(type="drive", robot=self.name, forward=0.3 + 0.1 * (tick % 2), left=0.2)

    async def release(self) -> None:
        await self.send(type="drive", robot=self.name, forward=0, left=0)

    async def send(self, **message) -> None:
        await self.socket.write_message(json.dumps(message))

    async def _listen(self):
        while True:
            text = await self.socket.read_message()
            if text is None:
                self.received["closed"] += 1
                return
            message = json.loads(text)
            self.received[message["type"]] += 1
            state = message["robots"].get(self.name) if message["type"] == "state" else None
            if state and state["pose"] != self.pose:
                self.pose = state["pose"]
                self.received["pose"] += 1


@contextmanager
def watching(clients: Sequence[Client]) -> Iterator[List[Tuple[float, bool]]]:
    """Yield a list that grows while chips change: the ms since their client sent, and whether the robot stopped.

    The stop of a robot that is driven is a wrong firing of the cockpit's dead man's switch.
    """
    changes, over = [], threading.Event()

    def poll():
        last = {client: client.chip[OUTPUTS] for client in clients}
        while not over.wait(POLL_INTERVAL):
            for client, outputs in last.items():
                if client.chip[OUTPUTS] != outputs:
                    changes.append((1000 * (time.monotonic() - client.sent), wheel_speeds(client.folder) == STOPPED))
                    last[client] = client.chip[OUTPUTS]

    thread = threading.Thread(target=poll)
    thread.start()
    try:
        yield changes
    finally:
        over.set()
        thread.join()


def cpu_times(home: str) -> Dict[str, Tuple[int, float]]:
    """Return {program: (number of processes, s of CPU time of all)} of those with this ROS_HOME."""
    times = {}
    for process in Path("/proc").glob("[0-9]*"):
        try:
            if f"ROS_HOME={home}\0".encode() not in (process / "environ").read_bytes():
                continue
            program = PROGRAM.search((process / "cmdline").read_text().replace("\0", " "))
            fields = (process / "stat").read_text().rpartition(")")[2].split()
        except OSError:  # it has just ended
            continue
        kind = program.group() if program else "roslaunch"
        number, used = times.get(kind, (0, 0.0))
        times[kind] = number + 1, used + (int(fields[11]) + int(fields[12])) / TICKS
    return times


async def all_of(clients: Sequence[Client], action) -> None:
    await asyncio.gather(*map(action, clients))


async def stop(clients: Sequence[Client]) -> float:
    """Let all drive, and one of them stop all; return the ms until all wheels are at zero."""
    await all_of(clients, lambda client: client.drive(0.5))
    start = time.monotonic()
    await clients[0].send(type="stop")
    while any(wheel_speeds(client.folder) != STOPPED for client in clients):
        await asyncio.sleep(POLL_INTERVAL)
    elapsed = time.monotonic() - start
    await clients[0].send(type="release")
    await all_of(clients, Client.release)
    await asyncio.sleep(0.5)
    return 1000 * elapsed


def row(what: str, milliseconds: Sequence[float]) -> str:
    """Return a row of a table in Markdown: median, 99th percentile, number of samples."""
    ordered = sorted(milliseconds)
    return f"| {what} | {median(ordered):.1f} | {ordered[int(0.99 * (len(ordered) - 1))]:.1f} | {len(ordered)} |"


async def measure(host: str, robots: int, seconds: float, home: str) -> None:
    """Print the figures of a class."""
    clients = [Client(f"/jetbot_{number:02d}") for number in range(1, robots + 1)]
    await asyncio.wait_for(all_of(clients, lambda client: client.join(host)), START_TIMEOUT)
    for client in clients:
        client.received.clear()
    before = cpu_times(home)
    with watching(clients) as changes:
        await all_of(clients, lambda client: client.drive(seconds))
    cpu = {kind: (number, 100 * (used - before[kind][1]) / number / seconds)
           for kind, (number, used) in cpu_times(home).items()}
    await all_of(clients, Client.release)
    counts = [client.received for client in clients]
    print("| | median | 99 % | samples |\n|---|---|---|---|")
    print(row(f"{robots} clients: a client sends, the chip changes (ms)", [latency for latency, _ in changes]))
    print(row(f"{robots} clients: stop to all wheels (ms)", [await stop(clients) for _ in range(STOPS)]))
    print(f"\nWithin {seconds:.0f} s: wheels at zero while driven: {sum(stopped for _, stopped in changes)}, "
          f"`lift` messages: {sum(each['lift'] for each in counts)}, closed sockets: "
          f"{sum(each['closed'] for each in counts)}.\nNew poses of the own robot per second and client: at least "
          f"{min(each['pose'] for each in counts) / seconds:.1f}.\n")
    print("| process | number | CPU each (%) |\n|---|---|---|")
    for kind, (number, percent) in sorted(cpu.items()):
        print(f"| {kind} | {number} | {percent:.1f} |")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", type=int, default=15)
    parser.add_argument("--seconds", type=float, default=30.0)
    options = parser.parse_args()
    end_on_sigterm()
    with tempfile.TemporaryDirectory(prefix="jetbot_") as home:
        os.environ.update(ROS_MASTER_URI=f"http://localhost:{free_port()}", ROS_HOME=home)
        port = free_port()
        roslaunch = start(["roslaunch", "jetbot_cockpit", "class.launch", f"robots:={options.robots}",
                           f"port:={port}"], Path(home, "roslaunch.log"))
        try:
            asyncio.run(measure(f"localhost:{port}", options.robots, options.seconds, home))
        finally:
            end([roslaunch])


if __name__ == "__main__":
    main()
