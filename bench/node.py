"""Whole nodes under a master of their own: how soon a command is in the chip, and what the node costs."""

import contextlib
import mmap
import os
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import psutil
import rosgraph
import rospy
import wire
from geometry_msgs.msg import Twist

from jetbot.fake.bus import chip_file, power_on

SCRIPT = '<node name="jetbot_controller" pkg="jetbot_bench" type="{}"><param name="folder" value="{{}}"/></node>'
LAUNCH = {  # contestant: what starts it, in a launch file, on the fake bus in a folder
    wire.OURS: '<include file="$(find jetbot_control_node)/launch/jetbot_controller.launch">'
               '<arg name="i2c_bus" value="fake:{}"/></include>',
    wire.BASELINE: SCRIPT.format("baseline.py"),
    wire.FLOOR: SCRIPT.format("floor.py"),
}
OUTPUTS = slice(0x06, 0x46)      # the chip's registers that tell which command it holds
LOOK = 0.0002                    # seconds between two looks at them
START, END, OBEY = 60, 60, 900   # seconds that nodes may take to listen, to end, to obey the last command


@contextlib.contextmanager
def started(*command, **options):
    """A process that ends with the block, politely or by force, with all of its group."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
                               **options)
    try:
        yield process
    finally:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(END)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()


@contextlib.contextmanager
def master():
    """A ROS master, and this program as a node of it, with logs and settings apart from the user's."""
    with socket.socket() as free:
        free.bind(("localhost", 0))
        port = str(free.getsockname()[1])
    with tempfile.TemporaryDirectory(prefix="jetbot_") as home:
        os.environ.update(ROS_MASTER_URI=f"http://localhost:{port}", ROS_HOME=home)
        with started("roscore", "-p", port):
            wait_for(rosgraph.is_master_online, START, "the ROS master did not start")
            rospy.init_node("bench", disable_signals=True)
            yield


class Failure(Exception):
    """A contestant did not do what was to be measured."""


def wait_for(condition, within, complaint):
    """Wait until the condition is true; Failure after so many seconds."""
    deadline = time.monotonic() + within
    while not condition():
        if time.monotonic() > deadline:
            raise Failure(complaint)
        time.sleep(0.002)


class Watch(threading.Thread):
    """Looks at the chips from outside, and notes when each first holds what a command that was sent makes of it.

    states: the registers after each command; sent, seen: seconds, by robot and command.
    """

    def __init__(self, chips, states):
        super().__init__(daemon=True)
        self._chips = chips
        self._commands = {state: command for command, state in enumerate(states)}
        self.over = False
        self.sent, self.seen = {}, {}

    def run(self):
        while not self.over:
            for robot, chip in enumerate(self._chips):
                key = robot, self._commands.get(chip[OUTPUTS])
                if key in self.sent and key not in self.seen:
                    self.seen[key] = time.perf_counter()
            time.sleep(LOOK)

    def latencies(self):
        """Milliseconds, a command; without those that newer ones overtook."""
        return [1000 * (self.seen[key] - sent) for key, sent in self.sent.items() if key in self.seen]


class Robots:
    """Nodes of one contestant, each with a namespace and a fake bus of its own, started by one roslaunch.

    startup: seconds from roslaunch until all listened.
    """

    def __init__(self, contestant, buses, publishers, roslaunch, startup):
        self._contestant, self._publishers, self.startup = contestant, publishers, startup
        self._chips = [map_chip(bus) for bus in buses]
        self._nodes = psutil.Process(roslaunch.pid).children()

    def drive(self, speeds, rate):
        """Command each robot ``rate`` times a second, one robot after the other, and wait until the last is obeyed.

        Returns the latencies in ms, that of the last command last, and the CPU share of a node in percent.
        """
        watch = Watch(self._chips, states(self._contestant, speeds))
        watch.start()
        cpu, start = self._cpu(), time.perf_counter()
        self._send(speeds, rate, watch.sent)
        self._wait_until(lambda: all((robot, len(speeds) - 1) in watch.seen for robot in range(len(self._chips))))
        share = (self._cpu() - cpu) / (time.perf_counter() - start) / len(self._chips)
        watch.over = True
        watch.join()
        return watch.latencies(), 100 * share

    def _send(self, speeds, rate, sent):
        start = time.perf_counter()
        for turn in range(len(speeds) * len(self._chips)):
            command, robot = divmod(turn, len(self._chips))
            time.sleep(max(0, start + turn / rate / len(self._chips) - time.perf_counter()))
            sent[robot, command] = time.perf_counter()
            self._publishers[robot].publish(twist(*speeds[command]))

    def _wait_until(self, obeyed):
        wait_for(lambda: obeyed() or not self._all_run(), OBEY, f"{self._contestant} does not obey the last command")
        if not self._all_run():
            raise Failure(f"{self._contestant} has died")

    def memory(self, children):
        """MiB (RSS) of a node; children: with the processes that it started."""
        return sum(process.memory_info().rss for process in self._processes(children)) / 2**20 / len(self._nodes)

    def _all_run(self):
        return all(node.is_running() for node in self._nodes)

    def _cpu(self):
        return sum(sum(process.cpu_times()[:2]) for process in self._processes(children=True))  # user, system

    def _processes(self, children):
        return [process for node in self._nodes for process in (node, *(node.children() if children else ()))]


def map_chip(bus):
    with chip_file(bus, 0x60).open("rb") as file:
        return mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)


def twist(left, right):
    """The command that makes left = x - z and right = x + z."""
    message = Twist()
    message.linear.x, message.angular.z = (left + right) / 2, (right - left) / 2
    return message


def states(contestant, speeds):
    """What the chip's outputs hold after each of these commands, by the contestant's own driver."""
    with wire.fake_bus() as folder:
        drive = wire.DRIVERS[contestant](folder)
        result = []
        for message in (twist(*pair) for pair in speeds):
            drive(message.linear.x - message.angular.z, message.linear.x + message.angular.z)
            result.append(chip_file(folder, 0x60).read_bytes()[OUTPUTS])
        return result


@contextlib.contextmanager
def running(contestant, count, clock):
    """This many Robots, on fake buses of ``clock`` Hz; they end with the block."""
    with tempfile.TemporaryDirectory(prefix="jetbot_") as folder, contextlib.ExitStack() as ending:
        buses = [Path(folder, f"r{robot}") for robot in range(count)]
        publishers = [rospy.Publisher(f"/{bus.name}/cmd_vel", Twist, queue_size=10) for bus in buses]
        for bus, publisher in zip(buses, publishers):
            power_on(bus)
            (bus / "clock").write_text(str(clock))
            ending.callback(publisher.unregister)
        file = Path(folder, "robots.launch")
        file.write_text(launch_file(contestant, buses))
        start = time.perf_counter()
        roslaunch = ending.enter_context(started("roslaunch", file, env=environment()))
        wait_for(lambda: all(publisher.get_num_connections() for publisher in publishers), START,
                 f"{contestant} did not start within {START} s")
        yield Robots(contestant, buses, publishers, roslaunch, time.perf_counter() - start)


def launch_file(contestant, buses):
    """XML that starts a robot a bus, in the namespace that the bus is called."""
    robots = (f'<group ns="{bus.name}">{LAUNCH[contestant].format(bus)}</group>' for bus in buses)
    return f"<launch>{''.join(robots)}</launch>"


def environment():
    """With this Python, which has Adafruit's library, and with the nodes in this folder."""
    return {**os.environ, "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}",
            "ROS_PACKAGE_PATH": f"{os.environ['ROS_PACKAGE_PATH']}:{Path(__file__).resolve().parent}"}
