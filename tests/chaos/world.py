"""What chaos happens to: a master, robots on fake buses, a cockpit with pages, and programs that command."""

import contextlib
import itertools
import json
import os
import re
import signal
import struct
import subprocess
import sys
import uuid
from pathlib import Path
from typing import Callable, Dict, Iterator, List, NamedTuple, Optional, Set, Tuple

from link import ISOLATED, Link
from page import HOST
from process import Process, ancestors, read

from jetbot.fake.motors import wheel_speeds
from jetbot.wait import wait_until
from jetbot_ros.master import NO_ANSWER, proxy
from processes import children, free_port, start

HERE = Path(__file__).resolve().parent
START_TIMEOUT = 40.0  # s
END_TIMEOUT = 8.0     # s for what belongs to an ended process to end
PORTS = itertools.count(20000)
DISK = "512k"
ACCELERATION = 0.2    # m/s^2, of the robots that start gently
CLASS = "chaos"
COOKIES = {"teacher": "teacher" + 36 * "0", "pupils": "pupils" + 37 * "0"}
ROBOTS = ("red", "green", "blue")
SPEEDS = {"order": 0.2, "repeat": 0.3, "port": 0.4, "page": 0.5, "teleop": 0.6}  # so that the wheels tell who it is
COMMANDERS = tuple(SPEEDS)
STARTED_BY = {"controller": "launch", "guard": "controller"}
PROGRAM = {"controller": "jetbot_controller.py", "guard": "jetbot.guard"}
ALL = ("master", "launch", "controller", "guard", "cockpit", "commander")
STATUS = re.compile(r"\]: \w+: (driving|stopped: .*)")


class Cast(NamedTuple):
    """Which robots there are, and those of them that start gently; judged: the first is simulated, and has a judge."""

    names: Tuple[str, ...]
    gentle: Tuple[str, ...]
    judged: bool


class Scene:
    """All processes below one folder, which is ROS's home and holds the buses. Ends them all when it is closed."""

    def __init__(self, folder: Path, cast: Cast, number: int = 0):
        self.folder, self.cast, self.names = folder, cast, cast.names
        self.port, self.page_port = new_port(), new_port()
        self.node_ports = {robot: new_port() for robot in self.names}
        self.link = Link(number, self.page_port)
        self.disk, self.temporary, self._clock = folder / "log", folder / "tmp", folder / "clock"
        self.store = folder / "store"
        self.temporary.mkdir()
        self.small_disks = [disk for disk in (self.disk, self.store) if mount(disk)]
        self.keep_codes()
        self.set_clock(0.0)
        self.environment = {
            **os.environ, "ROS_HOME": str(folder), "HOME": str(folder), "ROS_HOSTNAME": "localhost",
            "ROS_MASTER_URI": f"http://localhost:{self.port}", "ROS_LOG_DIR": str(self.disk), "PYTHONUNBUFFERED": "1",
            "TMPDIR": str(self.temporary), "CHAOS_CLOCK": str(self._clock), "ROSCONSOLE_STDOUT_LINE_BUFFERED": "1",
            "PYTHONPATH": f"{HERE}/clock:{os.environ.get('PYTHONPATH', '')}"}
        self.processes: List[Process] = []
        self._children: Dict[Tuple[str, str], Optional[Process]] = {}
        self._statuses: Dict[Tuple[Path, int], str] = {}

    def keep_codes(self) -> None:
        """Give the class codes and cookies that the pages know."""
        (self.store / CLASS).mkdir(mode=0o700)
        codes = {"teacher": 10 * "T", "pupils": 6 * "P"}
        (self.store / CLASS / "codes.json").write_text(
            json.dumps({label: [code, COOKIES[label]] for label, code in codes.items()}))

    def set_clock(self, offset: float) -> None:
        """Let the wall clock of all processes, but for the guards, be wrong by so many seconds."""
        with self._clock.open("r+b" if self._clock.exists() else "wb", buffering=0) as clock:
            clock.write(struct.pack("d", offset))

    def start(self, kind: str, *command: str, robot: str = "") -> Process:
        log = self.folder / f"{len(self.processes):02}_{kind}.log"
        process = Process(kind, start(command, log, env=self.environment), command, robot)
        self.processes.append(process)
        return process

    def run(self, *command: str, timeout: float = 60.0) -> subprocess.CompletedProcess:
        """Run a command to its end; after the timeout, in s, it is killed, and its code is 1."""
        try:
            return subprocess.run(command, env=self.environment, timeout=timeout, text=True, stdin=subprocess.DEVNULL,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        except subprocess.TimeoutExpired as late:
            return subprocess.CompletedProcess(command, 1, (late.stdout or b"").decode(), "")

    def page(self, action: str, *arguments: str, timeout: float, who: str = "teacher") -> subprocess.CompletedProcess:
        """Do something on a page of the cockpit, until that is confirmed."""
        return self.run(*self.page_command(who, action, *arguments), timeout=timeout)

    def page_command(self, who: str, *arguments: str) -> Tuple[str, ...]:
        return (sys.executable, str(HERE / "page.py"), self.link.address, str(self.page_port), COOKIES[who], *arguments)

    def ensure(self) -> None:
        """Start what is missing: master, robots, cockpit. Wait until the robots answer."""
        if not self.master_answers():
            for process in self.living("master"):
                process.signal(signal.SIGKILL)
            for launch in self.living("launch") if self.substitute_master() else ():
                launch.end()
            self.start("master", "rosmaster", "--core", "-p", str(self.port))
            self.wait(self.master_answers, "the master")
            self.ask_master("setParam", "/run_id", uuid.uuid1().hex)  # two roslaunch at once would each set their own
        starting = [self.launch(robot) for robot in self.names
                    if not (self.find("controller", robot) and self.status(robot))]  # its parameters may be lost
        if not self.living("cockpit"):
            self.start_cockpit()
        if self.cast.judged and not self.living("simulator"):
            self.start("simulator", "rosrun", "simulation", "simulator.py", f"__ns:={self.names[0]}",
                       f"_{self._bus(self.names[0])}")
        if self.cast.judged and not self.living("judge"):
            self.start("judge", "rosrun", "driving_tasks", "class_judge.py")
        for launch in starting:
            self.wait(lambda launch=launch: self.status(launch.robot), f"a status of {launch.robot}")

    def start_cockpit(self) -> None:
        others = ("_lan:=true", f"_name:={HOST}") if ISOLATED else ()  # else this computer's network would reach it
        self.start("cockpit", "rosrun", "jetbot_cockpit", "cockpit.py", f"_port:={self.page_port}", *others,
                   "_pictures:=false", f"_class:={CLASS}", f"_classes:={self.store}")

    def master_answers(self) -> bool:
        with contextlib.suppress(*NO_ANSWER):
            return bool(self.living("master") and self.ask_master("getPid"))
        return False

    def substitute_master(self) -> bool:
        """Return whether a roslaunch that lost the master while it started has started one of its own."""
        return any("rosmaster" in read(pid, "cmdline") for pid in self.pids())

    def ask_master(self, method: str, *arguments: object, caller: str = "/chaos"):
        """Return the master's answer; raise NO_ANSWER."""
        return getattr(proxy(self.environment["ROS_MASTER_URI"]), method)(caller, *arguments)[2]

    def topic(self, part: int, name: str) -> Set[str]:
        """Return the nodes that publish on a topic (part 0), or subscribe to it (1); none if no master answers."""
        with contextlib.suppress(*NO_ANSWER):
            return set(dict(self.ask_master("getSystemState")[part]).get(name, ()))
        return set()

    def launch(self, robot: str) -> Process:
        """Start a robot, instead of the one that may be there."""
        for process in self.living("launch"):
            if process.robot == robot:
                process.end()
        return self.start("launch", "roslaunch", "--wait", "jetbot_control_node", "jetbot_controller.launch",
                          f"robot_name:={robot}", self._bus(robot),
                          f"acceleration_limit:={ACCELERATION if robot in self.cast.gentle else 0.0}", robot=robot)

    def pids(self) -> Iterator[int]:
        """Yield the ids of all processes of this scene."""
        for path in Path("/proc").glob("[0-9]*"):
            if f"ROS_HOME={self.folder}\0" in read(path.name, "environ"):
                yield int(path.name)

    def status(self, robot: str) -> str:
        """Return what a robot's controller has logged last, "" if it has logged nothing."""
        log = next((process.popen.log for process in reversed(self.processes)
                    if (process.kind, process.robot) == ("launch", robot)), None)
        version = log and (log, log.stat().st_size)
        if log and version not in self._statuses:
            self._statuses[version] = (["", *STATUS.findall(log.read_text(errors="replace"))])[-1]
        return self._statuses[version] if log else ""

    def command(self, kind: str, robot: str) -> Process:
        """Start a commander of this kind for a robot."""
        topic, speed = f"/{robot}/cmd_vel", str(SPEEDS[kind])
        message = "geometry_msgs/Twist", f"{{linear: {{x: {speed}}}}}"
        if self.find("port", robot):  # its lid is closed
            self.node_ports[robot] = new_port()
        own = (sys.executable, str(HERE / "commander.py"), kind, topic, speed, str(self.node_ports[robot]))
        commands: Dict[str, Tuple[str, ...]] = {
            "order": ("rostopic", "pub", topic, *message), "repeat": ("rostopic", "pub", "-r", "10", topic, *message),
            "page": self.page_command("teacher", "drive", f"/{robot}", speed),
            "port": own, "teleop": own}
        return self.start(kind, *commands[kind], robot=robot)

    def living(self, *kinds: str) -> List[Process]:
        """Return the processes of these kinds, of all if there is none, that run or are frozen."""
        return [process for process in list(self.processes) if (not kinds or process.kind in kinds) and process.alive()]

    def find(self, kind: str, robot: str) -> Optional[Process]:
        """Return the newest living process of this kind; of this robot, if it belongs to one."""
        if kind in STARTED_BY:
            return self._find_child(kind, robot)
        found = [process for process in self.living(kind) if process.robot in ("", robot)]
        return found[-1] if found else None

    def _find_child(self, kind, robot):
        known = self._children.get((kind, robot))
        if known and known.alive():
            return known
        parent = self.find(STARTED_BY[kind], robot)
        pids = [pid for pid in sorted(children(parent.pid)) if PROGRAM[kind] in read(pid, "cmdline")] if parent else []
        command = ("rosrun", "jetbot_control_node", "jetbot_controller.py", f"__ns:={robot}", f"_{self._bus(robot)}")
        self._children[kind, robot] = Process(kind, parent.popen, command, robot, pids[-1]) if pids else None
        return self._children[kind, robot]

    def _bus(self, robot):
        return f"i2c_bus:=fake:{self.folder}/{robot}"

    def chip(self, robot: str) -> Path:
        """Return the file of a robot's motor board."""
        return self.folder / robot / "0x60"

    def wheels(self, robot: str) -> Tuple[float, float]:
        """Return the speeds (left, right) that the motor board of a robot gives its motors."""
        with contextlib.suppress(OSError):
            return wheel_speeds(str(self.folder / robot))
        return 0.0, 0.0  # unplugged: no power

    def wait(self, condition: Callable, what: str, within: float = START_TIMEOUT) -> None:
        """Wait until the condition is true; raise AssertionError after this many seconds."""
        assert wait_until(condition, within, 0.02), f"waited {within} s for {what}"

    def strays(self) -> List[str]:
        """Return the command lines of the processes that have outlived what started them."""
        known = {process.pid for process in self.living()}
        return [read(pid, "cmdline").replace("\0", " ") for pid in self.pids() if not known & {pid, *ancestors(pid)}]

    def close(self) -> List[str]:
        """End all processes; return the command lines and files of this scene that are left."""
        for kinds in (*COMMANDERS, "second", "bystander"), ("launch", "cockpit", "judge", "simulator"), ("master",):
            for process in self.living(*kinds):
                process.end()
        wait_until(lambda: not list(self.pids()), END_TIMEOUT, 0.1)
        left = [read(pid, "cmdline").replace("\0", " ") for pid in self.pids()]
        left += [str(file) for file in [*self.temporary.iterdir(), *self.folder.glob("*/0x*.*")]]
        self.link.close()
        for disk in self.small_disks:
            subprocess.run(["umount", "--lazy", str(disk)])
        return left


def new_port() -> int:
    """Return a port that no program is given before it is used: in a network of our own, one that Linux never gives."""
    return next(PORTS) if ISOLATED else free_port()


def mount(disk: Path) -> bool:
    """Make a folder, and a small disk there; return whether that is allowed."""
    disk.mkdir()
    return not subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={DISK}", "tmpfs", str(disk)],
                              stderr=subprocess.DEVNULL).returncode
