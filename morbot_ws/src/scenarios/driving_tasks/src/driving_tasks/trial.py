"""One program and a simulated robot of its own, on a ROS master of their own."""

import os
import re
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path
from typing import Dict, Iterator, List, Optional

import rospy
from geometry_msgs.msg import Twist
from roslib.packages import find_node

from jetbot.text import enumeration, printable
from jetbot.wait import wait_until
from jetbot_ros.master import is_reachable

from .attempt import INVITATION, Attempt
from .contained import end_program, program_limiter, running_children, start
from .live import POLL_INTERVAL, init_node
from .marks import Mark
from .robot import SimulatedRobot
from .tasks import Task

START_TIMEOUT = 30  # s until master, controller and simulator run
DRIVE_TIMEOUT = 20  # s until a program drives
LAST_COMMAND = 2    # s after the end of a program in which its last command may move the robot
MAX_ERROR = 4096    # bytes of a program's stderr that are read
MAX_SENTENCE = 200  # characters of it that are shown
CODE_LINE = re.compile(r' *File ".*", line (\d+)')  # of a traceback
OTHER_BUS = "other_bus"  # of the program's own Robot()
OTHERS = ("ROS_IP", "ROS_NAMESPACE", "ROS_LOG_DIR", "JETBOT_GUARD", "JETBOT_BOARD")  # variables of another robot


def try_program(task: Task, name: str, program: Path, config: str, folder: Path) -> Mark:
    """Return the mark of a program. Becomes a node; leaves processes behind. folder: an empty one, for their files."""
    environment = make_environment(folder)
    os.environ.clear()
    os.environ.update(environment)
    robot = []
    for command in robot_commands(folder, environment, config):
        robot.append(start(command, Path.cwd(), environment, folder / Path(command[0]).stem))
        if not wait_until(lambda: is_reachable(environment["ROS_MASTER_URI"]), START_TIMEOUT):
            return Mark(name, task.name, problem="Its ROS master does not start.")
    init_node([""])
    return Trial(task, name, program, folder, robot).run()


def make_environment(folder: Path) -> Dict[str, str]:
    """Return the environment of a program: a home, a ROS master, and for its Robot() a fake bus of its own."""
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        port = probe.getsockname()[1]
    home = folder / "home"
    home.mkdir()
    inherited = {name: value for name, value in os.environ.items() if name not in OTHERS}
    return {**inherited, "HOME": str(home), "ROS_HOME": str(folder / "ros"), "PYTHONDONTWRITEBYTECODE": "1",
            "ROS_MASTER_URI": f"http://localhost:{port}", "ROS_HOSTNAME": "localhost",
            "JETBOT_I2C_BUS": f"fake:{folder}/{OTHER_BUS}", "JETBOT_PORT": f"fake:{folder}/other_port"}


def robot_commands(folder: Path, environment: Dict[str, str], config: str) -> Iterator[List[str]]:
    """Yield the commands that start a ROS master, a controller and a simulator."""
    yield ["rosmaster", "--core", "-p", environment["ROS_MASTER_URI"].rpartition(":")[2]]
    bus, units = f"_i2c_bus:=fake:{folder}/bus", [f"_config:={config}"] if config else []
    yield [find_node("jetbot_control_node", "jetbot_controller.py")[0], bus, *units]
    yield [find_node("simulation", "simulator.py")[0], bus]


class Trial:
    """Starts the program when its robot is ready, and ends it when the drive is over. robot: the robot's processes."""

    def __init__(self, task: Task, name: str, program: Path, folder: Path, robot: List[subprocess.Popen]):
        self._task, self._name, self._program, self._folder, self._robot = task, name, program, folder, robot
        self._sentences: List[str] = []
        self._attempt = Attempt(task, SimulatedRobot(""), self._sentences.append)
        self._process: Optional[subprocess.Popen] = None
        self._started_at, self._ended_at = time.monotonic(), None

    def run(self) -> Mark:
        """Return the mark of the program."""
        problem, steps = "", self._attempt.steps()
        while not (self._attempt.mark or problem):
            self._attempt.robot.poll()
            next(steps, None)
            if self._process:
                problem = self._problem()
            elif self._attempt.ready and self._attempt.robot.is_controlled:
                self._start()
            elif time.monotonic() - self._started_at > START_TIMEOUT:
                problem = f"Its robot does not start. {last_line(self._folder / 'jetbot_controller')}"
            time.sleep(POLL_INTERVAL)
        if self._process:
            end_program(self._process)
        return self._attempt.mark._replace(name=self._name) if self._attempt.mark else Mark(
            self._name, self._task.name, problem=problem.strip())

    def _start(self):
        self._process = start([sys.executable, str(self._program)], self._folder / "home", os.environ,
                              self._folder / "program", program_limiter(round(self._task.time_limit) + DRIVE_TIMEOUT))
        self._started_at = time.monotonic()

    def _problem(self):
        """Return why there will be no drive, or "" while there may be one."""
        now = time.monotonic()
        if self._attempt.has_driven:
            return ""
        if now - self._started_at > DRIVE_TIMEOUT:
            interruption = self._sentences[-1] if self._sentences[-1] != INVITATION else self._wrong_robot()
            return f"It did not drive within {DRIVE_TIMEOUT} s. {interruption}"
        if self._process.poll() is None or running_children() - {process.pid for process in self._robot}:
            return ""
        self._ended_at = self._ended_at or now
        return "" if now - self._ended_at < LAST_COMMAND else "It ended before it drove. " + self._last_words()

    def _last_words(self):
        code = self._process.returncode
        if not code:
            return self._wrong_robot()
        return signal.strsignal(-code) or "" if code < 0 else last_line(self._folder / "program")

    def _wrong_robot(self):
        """Return a sentence about what the program drove instead; "" if that is nothing."""
        if os.path.exists(self._folder / OTHER_BUS):
            return "It drove a Robot() of its own; the robot that is judged obeys /cmd_vel."
        return describe_wrong_topics()


def last_line(file: Path) -> str:
    """Return the end of a file that any program may have written, in one line, with the last line of code it names."""
    with file.open("rb") as stream:
        stream.seek(max(0, stream.seek(0, os.SEEK_END) - MAX_ERROR))
        lines = stream.read().decode(errors="replace").strip().splitlines()
    named = [match[1] for match in map(CODE_LINE.match, lines) if match]
    return printable(lines[-1][:MAX_SENTENCE] + f" (line {named[-1]})" * bool(named)) if lines else ""


def describe_wrong_topics() -> str:
    """Return a sentence about the topics with commands that no robot obeys; "" if there is none."""
    topics = sorted(topic for topic, kind in rospy.get_published_topics() if kind == Twist._type)
    wrong = [printable(topic) for topic in topics if topic != "/cmd_vel"]
    return f"It publishes on {enumeration(wrong)}; its robot obeys /cmd_vel." if wrong else ""
