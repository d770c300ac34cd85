"""A class: class.launch, and for each robot a client of the cockpit that drives it."""

import asyncio
import json
import mmap
import os
import re
import threading
import time
from collections import Counter
from pathlib import Path
from typing import Callable, Dict, List, NamedTuple, Tuple

from browser.chromium import descendants
from tornado.httpclient import HTTPRequest
from tornado.websocket import websocket_connect

from jetbot.fake import chip_file, default_folder
from jetbot.fake.motors import STOPPED, wheel_speeds
from processes import end, free_port, start

RATE = 20  # Hz of each client
START_TIMEOUT, STOP_TIMEOUT = 180.0, 5.0  # s
POLL_INTERVAL = 0.002  # s
OUTPUTS = slice(0x06, 0x46)  # the chip's registers of all outputs
TICKS = os.sysconf("SC_CLK_TCK")  # of CPU time per second
PROGRAM = re.compile(r"jetbot\.guard|\w+(?=\.py\b)|rosmaster")


class Figures(NamedTuple):
    """What a drive showed. latencies: ms from a client's message to its chip; map_rate: Hz; cpu: {program: (number
    of processes, % of a core of each)}. stops: how often the wheels of a driven robot were at zero.
    """

    latencies: List[float]
    stops: int
    lifts: int
    closed: int
    map_rate: float
    cpu: Dict[str, Tuple[int, float]]


class Client:
    """Drives one robot, and counts what the cockpit sends. name: of the robot."""

    def __init__(self, name: str):
        self.name, self.sent, self.received, self.pose = name, 0.0, Counter(), None
        self.folder = default_folder(name)

    async def join(self, host: str, check: Callable[[], None]) -> None:
        """Connect, once the cockpit listens, and drive until the wheels turn. check: called before each new try."""
        request = HTTPRequest(f"ws://{host}/socket", headers={"Origin": f"http://{host}"})
        while True:
            try:
                self.socket = await websocket_connect(request)
                break
            except OSError:
                check()
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
        """Send new commands, each with another speed."""
        start = time.monotonic()
        for tick in range(round(seconds * RATE)):
            await asyncio.sleep(start + tick / RATE - time.monotonic())
            self.sent = time.monotonic()
            await self.send(type="drive", robot=self.name, forward=0.3 + 0.1 * (tick % 2), left=0.2)

    async def release(self) -> None:
        """Let the pad go."""
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


class SchoolClass:
    """A context in which the robots drive at their clients' commands. folder: for ROS's home."""

    def __init__(self, folder: Path, robots: int):
        os.environ.update(ROS_MASTER_URI=f"http://localhost:{free_port()}", ROS_HOME=str(folder))
        self._log, self._loop = folder / "roslaunch.log", asyncio.new_event_loop()
        self._clients = [Client(f"/jetbot_{number:02d}") for number in range(1, robots + 1)]

    def __enter__(self):
        port = free_port()
        self._roslaunch = start(["roslaunch", "jetbot_cockpit", "class.launch", f"robots:={len(self._clients)}",
                                 f"port:={port}"], self._log)
        try:
            self._run(asyncio.wait_for(self._all(lambda client: client.join(f"localhost:{port}", self._check)),
                                       START_TIMEOUT))
        except BaseException:
            self.__exit__()
            raise RuntimeError(f"the class does not start: {self._log.read_text()}") from None
        return self

    def __exit__(self, *_):
        end([self._roslaunch])

    def _check(self):
        """Raise ChildProcessError if roslaunch has ended."""
        if self._roslaunch.poll() is not None:
            raise ChildProcessError("roslaunch has ended")

    def drive(self, seconds: float) -> Figures:
        """Let all clients drive their robots, and measure."""
        for client in self._clients:
            client.received.clear()
        watch, before = Watch(self._clients), self._cpu_times()
        self._run(self._all(lambda client: client.drive(seconds)))
        watch.end()
        cpu = {kind: (number, 100 * (used - before[kind][1]) / number / seconds)
               for kind, (number, used) in self._cpu_times().items()}
        self._run(self._all(Client.release))
        received = [client.received for client in self._clients]
        return Figures(watch.latencies, watch.stops, sum(each["lift"] for each in received),
                       sum(each["closed"] for each in received), min(each["pose"] for each in received) / seconds, cpu)

    def stop(self) -> float:
        """Let all clients drive, and one of them stop all; return the ms until all wheels are at zero."""
        return self._run(self._stop())

    async def _stop(self):
        await self._all(lambda client: client.drive(0.5))
        start = time.monotonic()
        await self._clients[0].send(type="stop")
        while any(wheel_speeds(client.folder) != STOPPED for client in self._clients):
            await asyncio.sleep(POLL_INTERVAL)
        elapsed = time.monotonic() - start
        await self._clients[0].send(type="release")
        await self._all(Client.release)
        await asyncio.sleep(0.5)
        return 1000 * elapsed

    def _run(self, task):
        asyncio.set_event_loop(self._loop)
        return self._loop.run_until_complete(task)

    async def _all(self, action):
        await asyncio.gather(*map(action, self._clients))

    def _cpu_times(self):
        """Return {program: (number of processes, s of CPU time of all)} of roslaunch and what it has started."""
        times = {"this program": (1, time.process_time())}
        for pid in [self._roslaunch.pid, *descendants(self._roslaunch.pid)]:
            program = PROGRAM.search(Path(f"/proc/{pid}/cmdline").read_text().replace("\0", " "))
            kind = program.group() if program else "roslaunch"
            fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
            number, used = times.get(kind, (0, 0.0))
            times[kind] = number + 1, used + (int(fields[11]) + int(fields[12])) / TICKS
        return times


class Watch:
    """Polls the chips from now on, in a thread of its own: when each holds a new command, and how often it is stopped.

    The stop of a robot whose client pauses is a wrong firing of the cockpit's switch.
    """

    def __init__(self, clients: List[Client]):
        self.latencies, self.stops = [], 0
        self._clients, self._over = clients, threading.Event()
        self._thread = threading.Thread(target=self._poll)
        self._thread.start()

    def end(self) -> None:
        self._over.set()
        self._thread.join()

    def _poll(self):
        last = {client: client.chip[OUTPUTS] for client in self._clients}
        while not self._over.wait(POLL_INTERVAL):
            for client, outputs in last.items():
                if client.chip[OUTPUTS] != outputs:
                    self.latencies.append(1000 * (time.monotonic() - client.sent))
                    self.stops += wheel_speeds(client.folder) == STOPPED
                    last[client] = client.chip[OUTPUTS]
