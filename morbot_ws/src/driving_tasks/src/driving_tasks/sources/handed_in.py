"""Runs pupils' programs, one after the other, and judges how each one drives a simulated robot of its own."""

import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Dict, Iterator, List, Optional

import rospy
from geometry_msgs.msg import Twist
from roslib.packages import find_node

from jetbot.text import enumeration, printable
from jetbot.wait import wait_until
from jetbot_control_node import parameters
from jetbot_ros.master import is_reachable

from .. import contained
from ..report.marks import Mark
from ..scoring.tasks import Task
from .attempt import INVITATION, Attempt
from .folders import find_files
from .judged_robot import JudgedRobot
from .live import POLL_INTERVAL, init_node

OTHER_FILES = ("__init__.py", "setup.py")  # of a package, that are no programs
START_TIMEOUT = 30  # s until master, controller and simulator run
DRIVE_TIMEOUT = 20  # s until a program drives
LAST_COMMAND = 2    # s after the end of a program in which its last command may move the robot
MEMORY, FILE_SIZE = 2000, 10  # MB, of each process of a program, and of each file that it writes
MAX_ERROR = 4096    # bytes of a program's stderr that are read
MAX_SENTENCE = 200  # characters of it that are shown
CODE_LINE = re.compile(r' *File ".*", line (\d+)')  # of a traceback
OTHER_BUS = "other_bus"  # of the program's own Robot()
OTHERS = ("ROS_IP", "ROS_NAMESPACE", "ROS_LOG_DIR", "JETBOT_GUARD", "JETBOT_BOARD")  # variables of another robot


def judge_programs(task: Task, path: str, config: str = "", variation: float = 0.0) -> Iterator[Mark]:
    """Yield the mark of a program, or of each in a folder. Raises InvalidValue.

    They run with all rights of this user, one after the other, because motion is measured by the clock.
    config: the controller's file of parameters, such as si_units.yaml; variation: of their robot, the same for each.
    """
    if config:  # the controller would not start
        parameters.checked(parameters.load(parameters.find_file(config, ())))
    drive_time = round(task.time_limit) + DRIVE_TIMEOUT
    limits = contained.Limits(MEMORY, drive_time, START_TIMEOUT + drive_time + contained.END_TIMEOUT, FILE_SIZE)
    for file in find_files(Path(path).absolute(), ".py", without=OTHER_FILES):  # it runs in a folder of its own
        problem = file.problem or ("" if file.path.is_file() else "It is not a file.")
        outcome = (contained.Outcome(problem=problem) if problem else
                   contained.run(judge_program, task, file.path, config, variation, limits=limits))
        mark = outcome.value or Mark(file.name, task.name, problem=outcome.problem)
        yield mark._replace(name=file.name, robot="")


def judge_program(task: Task, program: Path, config: str, variation: float) -> Mark:
    """Return the mark of a program. Becomes a node, whose processes end here."""
    with tempfile.TemporaryDirectory(prefix="judge_") as folder:
        try:
            return Trial(task, program, Path(folder)).run(config, variation)
        finally:
            contained.end_children()


class Trial:
    """A program, and a robot of its own on a ROS master of their own. folder: an empty one, for their files."""

    def __init__(self, task: Task, program: Path, folder: Path):
        self._task, self._program, self._folder = task, program, folder
        self._sentences: List[str] = []
        self._process: Optional[subprocess.Popen] = None
        self._started_at, self._ended_at = time.monotonic(), None

    def run(self, config: str, variation: float) -> Mark:
        """Start the robot, then the program; return the program's mark when its drive is over."""
        os.environ.update(make_environment(self._folder))
        for name in OTHERS:
            os.environ.pop(name, None)
        for command in robot_commands(self._folder, config, variation):
            contained.start(command, Path.cwd(), self._folder / Path(command[0]).stem)
            if not wait_until(lambda: is_reachable(os.environ["ROS_MASTER_URI"]), START_TIMEOUT):
                return self._mark("Its ROS master does not start.")
        init_node([""])
        return self._judge(Attempt(self._task, JudgedRobot("", self._task.by_camera), self._sentences.append))

    def _judge(self, attempt):
        problem = ""
        while not (attempt.mark or problem):
            attempt.step()
            if self._process:
                problem = "" if attempt.has_driven else self._problem()
            elif attempt.ready and attempt.robot.is_controlled:
                self._start()
            elif time.monotonic() - self._started_at > START_TIMEOUT:
                problem = f"Its robot does not start. {last_line(self._folder / 'jetbot_controller')}"
            time.sleep(POLL_INTERVAL)
        return attempt.mark or self._mark(problem)

    def _mark(self, problem):
        return Mark(self._program.name, self._task.name, problem=problem.strip())

    def _start(self):
        self._robot = set(contained.children())
        self._process = contained.start([sys.executable, str(self._program)], Path(os.environ["HOME"]),
                                        self._folder / "program")
        self._started_at = time.monotonic()

    def _problem(self):
        """Return why there will be no drive, or "" while there may be one."""
        now = time.monotonic()
        if now - self._started_at > DRIVE_TIMEOUT:
            interruption = self._sentences[-1] if self._sentences[-1] != INVITATION else self._wrong_robot()
            return f"It did not drive within {DRIVE_TIMEOUT} s. {interruption}"
        if self._process.poll() is None or set(contained.children()) - self._robot:
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
        if (self._folder / OTHER_BUS).exists():
            return "It drove a Robot() of its own; the robot that is judged obeys /cmd_vel."
        topics = sorted(topic for topic, kind in rospy.get_published_topics() if kind == Twist._type)
        wrong = [printable(topic) for topic in topics if topic != "/cmd_vel"]
        return f"It publishes on {enumeration(wrong)}; its robot obeys /cmd_vel." if wrong else ""


def make_environment(folder: Path) -> Dict[str, str]:
    """Return what is special for a program: a home, a ROS master, and for its Robot() a fake bus of its own."""
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        port = probe.getsockname()[1]
    home = folder / "home"
    home.mkdir()
    return {"HOME": str(home), "ROS_HOME": str(folder / "ros"), "PYTHONDONTWRITEBYTECODE": "1",
            "ROS_MASTER_URI": f"http://localhost:{port}", "ROS_HOSTNAME": "localhost",
            "JETBOT_I2C_BUS": f"fake:{folder}/{OTHER_BUS}", "JETBOT_PORT": f"fake:{folder}/other_port"}


def robot_commands(folder: Path, config: str, variation: float) -> Iterator[List[str]]:
    """Yield the commands that start a ROS master, a controller and a simulator."""
    yield ["rosmaster", "--core", "-p", os.environ["ROS_MASTER_URI"].rpartition(":")[2]]
    bus, units = f"_i2c_bus:=fake:{folder}/bus", [f"_config:={config}"] if config else []
    yield [find_node("jetbot_control_node", "jetbot_controller.py")[0], bus, *units]
    yield [find_node("simulation", "simulator.py")[0], bus, f"_variation:={variation}"]


def last_line(file: Path) -> str:
    """Return the end of a file that any program may have written, in one line, with the last line of code it names."""
    with file.open("rb") as stream:
        stream.seek(max(0, stream.seek(0, os.SEEK_END) - MAX_ERROR))
        lines = stream.read().decode(errors="replace").strip().splitlines()
    named = [match[1] for match in map(CODE_LINE.match, lines) if match]
    return printable(lines[-1][:MAX_SENTENCE] + f" (line {named[-1]})" * bool(named)) if lines else ""
