"""Nodes under a master of their own: how soon the chips hold a command, and what the nodes take of the computer."""

import os
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Callable, Iterator, Sequence, Tuple

import numpy
import psutil
import rosgraph
import rospy
import wire
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist, Vector3

from jetbot.fake import chip_file
from jetbot.wait import wait_until

# In a launch file: what starts an implementation on the fake bus in a folder.
DRIVER = ('<include file="$(find jetbot_control_node)/launch/jetbot_controller.launch">'
          '<arg name="i2c_bus" value="fake:{folder}"/></include>')
OTHER = ('<node name="jetbot_controller" pkg="jetbot_bench" type="{name}.py">'
         '<param name="folder" value="{folder}"/></node>')
POLL_INTERVAL, START_TIMEOUT, SHUTDOWN_TIMEOUT, OBEY_TIMEOUT = 0.0002, 60, 60, 300  # s
QUIET = 3.0  # % of a core that a node and its guard take at most when they have started


class Failure(Exception):
    """An implementation did not do what was to be measured."""


def require(condition: Callable[[], object], timeout: float, problem: str) -> None:
    """Wait until the condition is true; raise Failure after ``timeout`` seconds."""
    if not wait_until(condition, timeout, 0.002):
        raise Failure(problem)


@contextmanager
def started(*command) -> Iterator[subprocess.Popen]:
    """Start a process; at the end of the block, interrupt it, and kill its group if it does not end."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        yield process
    finally:
        process.send_signal(signal.SIGINT)
        if not wait_until(lambda: process.poll() is not None, SHUTDOWN_TIMEOUT):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()


@contextmanager
def master() -> Iterator[None]:
    """Start a ROS master with this program as a node; logs and settings are apart from the user's.

    What is started from now on uses this Python, which has Adafruit's library, and has the nodes in this folder.
    """
    with socket.socket() as free:
        free.bind(("localhost", 0))
        port = str(free.getsockname()[1])
    with tempfile.TemporaryDirectory(prefix="jetbot_") as home:
        os.environ.update(ROS_MASTER_URI=f"http://localhost:{port}", ROS_HOME=home,
                          PATH=f"{Path(sys.executable).parent}:{os.environ['PATH']}",
                          ROS_PACKAGE_PATH=f"{os.environ['ROS_PACKAGE_PATH']}:{Path(__file__).resolve().parent}")
        with started("roscore", "-p", port):
            require(rosgraph.is_master_online, START_TIMEOUT, "the ROS master did not start")
            rospy.init_node("bench", disable_signals=True)
            yield


class Robots:
    """Nodes of one implementation, each on its own fake bus of ``clock`` Hz; startup: s until all had subscribed."""

    def __init__(self, implementation: str, clock: int, buses: Sequence[Path], roslaunch: int):
        start = time.perf_counter()
        self._implementation, self._clock = implementation, clock
        self._chips = [numpy.memmap(chip_file(bus, wire.ADDRESS), mode="r") for bus in buses]
        self._publishers = [rospy.Publisher(f"/{bus.name}/cmd_vel", Twist, queue_size=10) for bus in buses]
        require(lambda: all(publisher.get_num_connections() for publisher in self._publishers), START_TIMEOUT,
                f"{implementation} did not start within {START_TIMEOUT} s")
        self.startup = time.perf_counter() - start
        self._nodes = psutil.Process(roslaunch).children()
        self._guards = [guard for node in self._nodes for guard in node.children()]
        require(lambda: sum(self.cpu_during(lambda: time.sleep(0.5))) < QUIET, START_TIMEOUT,
                f"{implementation} is never idle")

    def drive(self, speeds: Sequence[wire.Speeds], rate: float) -> Tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray]:
        """Send each robot ``rate`` commands per second, one robot after the other; wait until the last is obeyed.

        Returns the ms from publish to last bit, the same less the wire time of the command's own writes, and what
        ``cpu_during`` returns. The first command does not count: what it changes depends on the one before.
        """
        commands = wire.replay(self._implementation, speeds)
        sent, seen, over = {}, {}, threading.Event()  # sent, seen: times in s by (robot, number of the command)
        threading.Thread(target=self._poll, args=(commands, sent, seen, over)).start()
        try:
            cpu = self.cpu_during(lambda: self._send(speeds, rate, sent, seen))
        finally:
            over.set()
        keys = [key for key in list(seen) if key[1]]
        latencies = numpy.array([1000 * (seen[key] - sent[key]) for key in keys])
        return latencies, latencies - [1000 * commands[number].wire_bits / self._clock for _, number in keys], cpu

    def _poll(self, commands, sent, seen, over):
        """Poll the chips; record when each first holds a command."""
        numbers = {command.outputs: number for number, command in enumerate(commands)}
        while not over.wait(POLL_INTERVAL):
            for robot, chip in enumerate(self._chips):
                key = robot, numbers.get(chip[wire.OUTPUTS].tobytes())
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

    def cpu_during(self, action: Callable[[], object]) -> numpy.ndarray:
        """Return the CPU, in % of a core, that a node and that its guard use while the action runs."""
        def cpu_time(process):  # in s, of all threads, by the process's own clock: clock_getcpuclockid(3) on Linux
            return time.clock_gettime(~process.pid << 3 | 2)

        before, start = self._each(cpu_time), time.perf_counter()
        action()
        return 100 * (self._each(cpu_time) - before) / (time.perf_counter() - start)

    def memory(self) -> numpy.ndarray:
        """Return the resident memory in MiB of a node and of its guard."""
        return self._each(lambda process: process.memory_info().rss / 2**20)

    def _each(self, quantity):
        return numpy.array([sum(map(quantity, group)) / len(self._nodes) for group in (self._nodes, self._guards)])


def transfer_rate(seconds: float) -> float:
    """Return the bus transfers per second that the driver reports in /diagnostics."""
    def count():
        message = rospy.wait_for_message("/diagnostics", DiagnosticArray, START_TIMEOUT)
        values = {pair.key: pair.value for status in message.status for pair in status.values}
        return numpy.array([message.header.stamp.to_sec(), int(values["transfers"])])

    start = count()
    time.sleep(seconds)
    elapsed, transfers = count() - start
    return transfers / elapsed


@contextmanager
def running(implementation: str, count: int, clock: int) -> Iterator[Robots]:
    """Start this many robots, in namespaces and on fake buses of their own; they end with the block."""
    with ExitStack() as stack:
        buses = [Path(stack.enter_context(wire.fake_bus(clock))) for _ in range(count)]
        robot = DRIVER if implementation == "driver" else OTHER
        groups = (f'<group ns="{bus.name}">{robot.format(name=implementation, folder=bus)}</group>' for bus in buses)
        file = Path(os.environ["ROS_HOME"], "robots.launch")
        file.write_text(f"<launch>{''.join(groups)}</launch>")
        roslaunch = stack.enter_context(started("roslaunch", file))
        yield Robots(implementation, clock, buses, roslaunch.pid)

