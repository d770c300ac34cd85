"""A ROS master, robots on fake buses and a cockpit, all of them real processes that end with the test."""

import os
import re
import signal
import subprocess
from pathlib import Path
from typing import Callable, List, Tuple

import rosgraph

from harness import CONTROLLER, START_TIMEOUT, end, free_port, program
from jetbot.fake.motors import STOPPED, wheel_speeds
from jetbot.wait import wait_until

NAME = "class.test"  # a name of this computer that needs a code; the browsers of the tests resolve it to 127.0.0.1
DRIVE_TIMEOUT = 30.0  # s until what a person does turns a wheel
STOP_TIMEOUT = 1.5  # s; the switch fires after 0.3 s, and nothing else stops a robot whose cmd_vel_timeout is 0
RETRY_AFTER = 1.5  # s

Wheels = Callable[[float, float], bool]  # a condition for the speeds left, right


def moving(left: float, right: float) -> bool:
    return (left, right) != STOPPED


class World:
    """robots: their names, which are namespaces. folder: empty, for their buses and logs."""

    def __init__(self, folder: Path, *robots: str):
        self._folder, self.robots, self._processes = folder, robots, []
        master, self.port = free_port(), free_port()
        self._uri = f"http://localhost:{master}"
        self._environment = {**os.environ, "ROS_MASTER_URI": self._uri, "ROS_HOME": str(folder), "HOME": str(folder)}
        self.start("rosmaster", "--core", "-p", str(master))
        self.wait_for(lambda: rosgraph.is_master_online(self._uri), START_TIMEOUT, "the ROS master")
        for robot in robots:
            bus = f"_i2c_bus:=fake:{folder / robot}"
            self.start(CONTROLLER, f"__ns:=/{robot}", bus, "_cmd_vel_timeout:=0")
            self.start(program("simulation", "simulator.py"), f"__ns:=/{robot}", bus)
        self.start_cockpit()
        for robot in robots:
            self.wait_for(lambda robot=robot: self._nodes(1, f"/{robot}/cmd_vel"), START_TIMEOUT, f"{robot}")

    def start(self, *command: str) -> subprocess.Popen:
        """Start a process of this world."""
        log = self._folder / f"log_{len(self._processes)}"
        with log.open("w") as file:
            process = subprocess.Popen(command, stdout=file, stderr=file, env=self._environment, start_new_session=True)
        process.log = log
        self._processes.append(process)
        return process

    def start_cockpit(self) -> None:
        """Start the cockpit, and wait until it prints the addresses with the codes of a class."""
        self.cockpit = self.start(program("jetbot_cockpit", "cockpit.py"), f"_port:={self.port}", "_lan:=true",
                                  f"_name:={NAME}")
        self.wait_for(lambda: len(self.codes()) == 2, START_TIMEOUT, "the cockpit's codes")

    def codes(self) -> dict:
        """Return the addresses that the cockpit printed, by "teacher" and "pupil"."""
        urls = re.findall(rf"http://{NAME}:{self.port}/#\w+", self.cockpit.log.read_text())
        return {"teacher" if len(url.partition("#")[2]) == 10 else "pupil": url for url in urls}

    @property
    def address(self) -> str:
        """The cockpit's address for whoever sits at this computer: a teacher without a code."""
        return f"http://localhost:{self.port}/"

    def wheels(self, robot: str) -> Tuple[float, float]:
        """Return the speeds (left, right) of a robot's wheels, from the registers of its fake chip."""
        return wheel_speeds(self._folder / robot)

    def publishers(self, robot: str) -> List[str]:
        """Return the names of the nodes that publish commands for a robot."""
        return self._nodes(0, f"/{robot}/cmd_vel")

    def wait_for(self, condition: Callable[[], object], within: float, what: str) -> None:
        """Fail unless the condition becomes true within this many seconds; what: its description."""
        assert wait_until(condition, within), f"waited {within} s for {what}; wheels " \
            f"{[self.wheels(robot) for robot in self.robots]}{self._logs()}"

    def wait_for_stop(self, robot: str, within: float = STOP_TIMEOUT) -> None:
        """Fail unless both wheels of a robot stop within this many seconds."""
        self.wait_for(lambda: self.wheels(robot) == STOPPED, within, f"{robot} to stop")

    def drive(self, page, robot: str, forward: float = 1.0, left: float = 0.0, wanted: Wheels = moving) -> None:
        """Put a finger on the pad of a page, and leave it there once the wheels turn as wanted."""
        self.hold(lambda: page.touch(forward, left), page.lift, robot, wanted)

    def hold(self, press: Callable, let_go: Callable, robot: str, wanted: Wheels = moving) -> None:
        """Press, and let go and press again until the wheels turn as wanted.

        The pages and processes of a busy computer pause for longer than the switch allows.
        """
        def obeys():
            press()
            return wait_until(lambda: wanted(*self.wheels(robot)), RETRY_AFTER) or let_go()

        self.wait_for(obeys, DRIVE_TIMEOUT, f"the wheels of {robot}")

    def stays(self, robot: str, wanted: Wheels, for_seconds: float = 0.5) -> None:
        """Fail if the speeds (left, right) of a robot's wheels are not as wanted for this many seconds."""
        assert not wait_until(lambda: not wanted(*self.wheels(robot)), for_seconds), \
            f"{robot} turns its wheels at {self.wheels(robot)}{self._logs()}"

    def stays_stopped(self, robot: str, for_seconds: float = 0.5) -> None:
        """Fail if a wheel of a robot turns within this many seconds."""
        self.stays(robot, lambda *wheels: wheels == STOPPED, for_seconds)

    def emergency_stop(self, *options: str) -> None:
        """Stop all robots as ./morbot stop does."""
        assert self.start(program("jetbot_control_node", "emergency_stop.py"), *options).wait(START_TIMEOUT) == 0

    def start_stranger(self, name: str, status: str) -> subprocess.Popen:
        """Start a node that publishes a controller's status in this namespace, and nothing else."""
        return self.start("rostopic", "pub", "-l", f"/{name}/jetbot_controller/status", "std_msgs/String", status)

    def kill(self, process: subprocess.Popen) -> None:
        """Kill a process, and wait for its end."""
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()

    def close(self) -> None:
        """End all processes."""
        end(self._processes[1:])
        end(self._processes[:1])  # the master, which the others still need

    def _nodes(self, role, topic):
        """role: 0 publishers, 1 subscribers."""
        return dict(rosgraph.Master("/test", self._uri).getSystemState()[role]).get(topic, [])

    def _logs(self):
        return "".join(f"\n--- {process.args}\n{process.log.read_text()}" for process in self._processes)
