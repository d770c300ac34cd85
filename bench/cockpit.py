"""A class that drives by the cockpit: class.launch, and for each simulated robot a client that drives it."""

import asyncio
import json
import re
import time
from collections import Counter
from pathlib import Path
from typing import Awaitable, Callable, Dict, List, Sequence, Tuple

import launched
from tornado.httpclient import HTTPRequest
from tornado.websocket import websocket_connect
from wire import OUTPUTS

from jetbot.fake import default_folder
from jetbot.fake.motors import STOPPED, wheel_speeds

RATE, STOPS = 20, 10  # commands per second of each client; how often all are stopped
START_TIMEOUT = 180.0  # s
POLL_INTERVAL = 0.002  # s
PROGRAM = re.compile(r"jetbot\.guard|\w+(?=\.py\b)")

Clients = Sequence["Client"]


class Client:
    """Drives one robot, every command with a new speed, and counts the poses that the cockpit sends."""

    def __init__(self, name: str):
        self.name, self.bus = name, default_folder(name)
        self.sent, self.pose, self.poses = 0.0, None, 0

    async def join(self, host: str) -> None:
        """Connect, once the cockpit listens, and drive until the wheels turn."""
        request, self.socket = HTTPRequest(f"ws://{host}/socket", headers={"Origin": f"http://{host}"}), None
        while not self.socket:
            try:
                self.socket = await websocket_connect(request)
            except OSError:
                await asyncio.sleep(0.5)
        self.listener = asyncio.ensure_future(self._listen())
        while wheel_speeds(self.bus) == STOPPED:
            await self.release()  # a drive that the cockpit has refused goes on being refused until then
            await asyncio.sleep(0.5)
            await self.drive(0.5)
        await self.release()
        self.chip = launched.open_chip(self.bus)

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
            message = json.loads(await self.socket.read_message())
            state = message["robots"].get(self.name) if message["type"] == "state" else None
            if state and state["pose"] != self.pose:
                self.pose = state["pose"]
                self.poses += 1


async def watch(clients: Clients, changes: List[Tuple[float, bool]]) -> None:
    """Add, whenever a chip changes, the ms since its client sent, and whether its wheels are at zero."""
    last = {client: client.chip[OUTPUTS] for client in clients}
    while True:
        await asyncio.sleep(POLL_INTERVAL)
        for client, outputs in last.items():
            if client.chip[OUTPUTS] != outputs:
                changes.append((1000 * (time.monotonic() - client.sent), wheel_speeds(client.bus) == STOPPED))
                last[client] = client.chip[OUTPUTS]


async def all_of(clients: Clients, action: Callable[["Client"], Awaitable[None]]) -> None:
    await asyncio.gather(*map(action, clients))


async def stop(clients: Clients) -> float:
    """Let all drive, and one of them stop all; return the ms until all wheels are at zero."""
    await all_of(clients, lambda client: client.drive(0.5))
    start = time.monotonic()
    await clients[0].send(type="stop")
    while any(wheel_speeds(client.bus) != STOPPED for client in clients):
        await asyncio.sleep(POLL_INTERVAL)
    elapsed = time.monotonic() - start
    await clients[0].send(type="release")
    await all_of(clients, Client.release)
    await asyncio.sleep(0.5)
    return 1000 * elapsed


def programs(roslaunch: int) -> Dict[int, str]:
    """Return {process: program} of the nodes and their guards."""
    nodes = launched.children(roslaunch)
    processes = nodes + [child for node in nodes for child in launched.children(node)]
    found = {process: PROGRAM.search(Path(f"/proc/{process}/cmdline").read_text()) for process in processes}
    return {process: match.group() for process, match in found.items() if match}


async def measure_class(host: str, count: int, seconds: float, roslaunch: int):
    """Return software's delays and stops in ms, new poses per second, and {program: CPU of each in % of a core}."""
    clients = [Client(f"/jetbot_{number:02d}") for number in range(1, count + 1)]
    await asyncio.wait_for(all_of(clients, lambda client: client.join(host)), START_TIMEOUT)
    running, changes = programs(roslaunch), []
    before = {process: launched.cpu_time([process]) for process in running}
    seen = [client.poses for client in clients]
    watcher = asyncio.ensure_future(watch(clients, changes))
    await all_of(clients, lambda client: client.drive(seconds))
    watcher.cancel()
    cpu, numbers = Counter(), Counter(running.values())
    for process, program in running.items():
        cpu[program] += 100 * (launched.cpu_time([process]) - before[process]) / seconds / numbers[program]
    poses = min(client.poses - earlier for client, earlier in zip(clients, seen)) / seconds
    await all_of(clients, Client.release)
    return changes, [await stop(clients) for _ in range(STOPS)], poses, cpu


def measure(count: int, seconds: float):
    """Start a class of ``count`` robots and return what measure_class returns."""
    port = launched.free_port()
    command = "roslaunch", "jetbot_class", "class.launch", f"robots:={count}", f"port:={port}"
    with launched.started(*command) as roslaunch:
        return asyncio.run(measure_class(f"localhost:{port}", count, seconds, roslaunch))
