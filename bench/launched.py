"""Nodes under a master of their own: how soon their chips hold a command, and what CPU they use."""

import mmap
import os
import sys
import tempfile
import threading
import time
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Callable, Iterable, Iterator, List, Sequence, Tuple

import rosgraph
import rospy
import wire
from geometry_msgs.msg import Twist, Vector3

from jetbot.fake import chip_file
from jetbot.wait import wait_until

sys.path.append(str(Path(__file__).resolve().parents[1] / "tests/ros"))
from processes import children, end, free_port, start  # noqa: E402

# In a launch file: what starts an implementation on the fake bus in a folder.
DRIVER = ('<include file="$(find jetbot_control_node)/launch/jetbot_controller.launch">'
          '<arg name="i2c_bus" value="fake:{folder}"/></include>')
OTHER = ('<node name="jetbot_controller" pkg="jetbot_bench" type="{name}.py">'
         '<param name="folder" value="{folder}"/></node>')
CLOCK = 100_000  # of the buses, in Hz
POLL_INTERVAL, START_TIMEOUT, OBEY_TIMEOUT = 0.0002, 60, 300  # s
QUIET = 3.0  # % of a core that a robot uses at most once it has started


def require(condition: Callable[[], object], timeout: float, problem: str) -> None:
    """Wait until the condition is true; end the program after ``timeout`` seconds."""
    if not wait_until(condition, timeout, 0.002):
        sys.exit(f"bench: {problem}")


@contextmanager
def started(*command: str) -> Iterator[int]:
    """Start a process and yield its id; it ends with the block."""
    process = start([*command], Path(os.environ["ROS_HOME"], f"{command[0]}.log"))
    try:
        yield process.pid
    finally:
        end([process])


@contextmanager
def master() -> Iterator[None]:
    """Start a ROS master with this program as a node; logs and settings are apart from the user's.

    What is started from now on uses this Python, which has Adafruit's library, and has the nodes in this folder.
    """
    port = free_port()
    with tempfile.TemporaryDirectory(prefix="jetbot_") as home:
        os.environ.update(ROS_MASTER_URI=f"http://localhost:{port}", ROS_HOME=home,
                          PATH=f"{Path(sys.executable).parent}:{os.environ['PATH']}",
                          ROS_PACKAGE_PATH=f"{os.environ['ROS_PACKAGE_PATH']}:{Path(__file__).resolve().parent}")
        with started("roscore", "-p", str(port)):
            require(rosgraph.is_master_online, START_TIMEOUT, "the ROS master did not start")
            rospy.init_node("bench", disable_signals=True)
            yield


def cpu_time(processes: Iterable[int]) -> float:
    """Return the CPU time of all threads in s, by the processes' own clocks: clock_getcpuclockid(3) on Linux."""
    return sum(time.clock_gettime(~process << 3 | 2) for process in processes)


def open_chip(bus: str) -> mmap.mmap:
    """Return the registers of the chip on the fake bus in a folder; they follow the file."""
    with chip_file(bus, wire.ADDRESS).open("rb") as chip:
        return mmap.mmap(chip.fileno(), 0, prot=mmap.PROT_READ)


class Robots:
    """Nodes of one implementation, each on a fake bus of its own; startup: s until all had subscribed."""

    def __init__(self, implementation: str, buses: Sequence[str], roslaunch: int):
        start = time.perf_counter()
        self._implementation, self._chips = implementation, list(map(open_chip, buses))
        self._publishers = [rospy.Publisher(f"/{Path(bus).name}/cmd_vel", Twist, queue_size=10) for bus in buses]
        require(lambda: all(publisher.get_num_connections() for publisher in self._publishers), START_TIMEOUT,
                f"{implementation} did not start within {START_TIMEOUT} s")
        self.startup = time.perf_counter() - start
        nodes = children(roslaunch)
        self._processes = nodes + [guard for node in nodes for guard in children(node)]
        require(lambda: self.cpu_during(lambda: time.sleep(0.5)) < QUIET, START_TIMEOUT,
                f"{implementation} is never idle")

    def cpu_during(self, action: Callable[[], object]) -> float:
        """Return the CPU, in % of a core, that a node and its guard use while the action runs."""
        before, start = cpu_time(self._processes), time.perf_counter()
        action()
        return 100 * (cpu_time(self._processes) - before) / (time.perf_counter() - start) / len(self._chips)

    def drive(self, speeds: Sequence[wire.Speeds], rate: float) -> Tuple[List[float], float]:
        """Send each robot ``rate`` commands per second, one robot after the other; wait until the last is obeyed.

        Returns software's share of each command in ms: from publish until the chip holds it, less the wire time of its
        own writes; and the CPU, see cpu_during. The first command does not count: what it changes depends on the one
        before.
        """
        commands = wire.replay(self._implementation, speeds)
        sent, seen, over = {}, {}, threading.Event()  # sent, seen: times in s by (robot, number of the command)
        threading.Thread(target=self._poll, args=(commands, sent, seen, over)).start()
        try:
            cpu = self.cpu_during(lambda: self._send(speeds, rate, sent, seen))
        finally:
            over.set()
        return [1000 * (seen[key] - sent[key] - commands[key[1]].wire_bits / CLOCK)
                for key in list(seen) if key[1]], cpu

    def _poll(self, commands, sent, seen, over):
        """Poll the chips; record when each first holds a command."""
        numbers = {command.outputs: number for number, command in enumerate(commands)}
        while not over.wait(POLL_INTERVAL):
            for robot, chip in enumerate(self._chips):
                key = robot, numbers.get(chip[wire.OUTPUTS])
                if key in sent and key not in seen:
                    seen[key] = time.perf_counter()

    def _send(self, speeds, rate, sent, seen):
        start, robots = time.perf_counter(), len(self._chips)
        for turn in range(len(speeds) * robots):
            number, robot = divmod(turn, robots)
            left, right = speeds[number]  # left = x - z, right = x + z
            time.sleep(max(0, start + turn / rate / robots - time.perf_counter()))
            sent[robot, number] = time.perf_counter()
            self._publishers[robot].publish(Vector3((left + right) / 2, 0, 0), Vector3(0, 0, (right - left) / 2))
        last = {(robot, len(speeds) - 1) for robot in range(robots)}
        require(lambda: last <= seen.keys(), OBEY_TIMEOUT, f"{self._implementation} does not obey the last command")


@contextmanager
def running(implementation: str, count: int) -> Iterator[Robots]:
    """Start this many robots, in namespaces and on fake buses of their own; they end with the block."""
    with ExitStack() as stack:
        buses = [stack.enter_context(wire.fake_bus(CLOCK)) for _ in range(count)]
        robot = DRIVER if implementation == "driver" else OTHER
        groups = (f'<group ns="{Path(bus).name}">{robot.format(name=implementation, folder=bus)}</group>'
                  for bus in buses)
        file = Path(os.environ["ROS_HOME"], "robots.launch")
        file.write_text(f"<launch>{''.join(groups)}</launch>")
        yield Robots(implementation, buses, stack.enter_context(started("roslaunch", str(file))))
