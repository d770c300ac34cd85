"""What chaos happens to: a master, robots on fake buses, a cockpit with pages, and programs that command."""

import contextlib
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Callable, Dict, List, Optional, Tuple

from jetbot.fake.motors import wheel_speeds
from processes import end, free_port, start

ROOT = Path(__file__).resolve().parents[2]
START_TIMEOUT = 40.0  # s
ROBOTS = ("red", "green", "blue")
TWIST = "{linear: {x: %s}}"
SPEEDS = {"order": 0.2, "repeat": 0.3, "page": 0.5}  # each commander has its own, so that the wheels tell who it is


class Process:
    """A process of the scene: ``kind`` is what it is; ``robot``: which it drives or commands."""

    def __init__(self, kind: str, popen: subprocess.Popen, command: Tuple[str, ...], robot: str = "", pid: int = 0):
        self.kind, self.popen, self.command, self.robot = kind, popen, command, robot
        self.pid = pid or popen.pid

    def __str__(self) -> str:
        return f"{self.kind} {self.robot}".strip()

    def state(self) -> str:
        """Return its state by proc(5), Z if it has ended."""
        with contextlib.suppress(OSError):
            return Path(f"/proc/{self.pid}/stat").read_text().rpartition(")")[2].split()[0]
        return "Z"

    def alive(self) -> bool:
        """Return whether it runs, or is frozen."""
        return self.state() != "Z"

    def signal(self, signum: int) -> None:
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.pid, signum)

    def end(self) -> None:
        self.signal(signal.SIGCONT)
        end([self.popen])


class Scene:
    """All processes below one folder, which is ROS's home and holds the buses. Ends them all when it is closed."""

    def __init__(self, folder: Path, robots: int, pages: int):
        self.folder, self.names = folder, ROBOTS[:robots]
        self.port, self.page_port = free_port(), free_port()
        self.environment = {**os.environ, "ROS_HOME": str(folder), "HOME": str(folder), "ROS_HOSTNAME": "localhost",
                            "ROS_MASTER_URI": f"http://localhost:{self.port}", "PYTHONUNBUFFERED": "1"}
        self.processes: List[Process] = []
        self.pages = pages

    def start(self, kind: str, *command: str, robot: str = "") -> Process:
        log = self.folder / f"{len(self.processes):02}_{kind}.log"
        process = Process(kind, start(command, log, env=self.environment), command, robot)
        self.processes.append(process)
        return process

    def again(self, process: Process) -> Process:
        """Start the same command beside a process."""
        return self.start("second", *process.command, robot=process.robot)

    def run(self, *command: str, timeout: float = 30.0) -> subprocess.CompletedProcess:
        """Run a command to its end."""
        return subprocess.run(command, env=self.environment, timeout=timeout, text=True, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def ensure(self) -> None:
        """Start what is missing: master, robots, cockpit. Wait until the robots answer."""
        if not self._master_answers():
            for process in self.living("master"):
                process.signal(signal.SIGKILL)
            self.start("master", "rosmaster", "--core", "-p", str(self.port))
            self.wait(self._master_answers, "the master")
            for process in self.living("launch", "cockpit"):
                process.end()  # as a person does who restarts roscore
        for robot in self.names:
            if not [process for process in self.living("controller") if process.robot == robot]:
                self._launch(robot)
        if not self.living("cockpit"):
            self.start("cockpit", "rosrun", "jetbot_cockpit_server", "cockpit.py", f"_port:={self.page_port}")
            self._adopt_last("cockpit.py")

    def _master_answers(self) -> bool:
        with contextlib.suppress(subprocess.TimeoutExpired):
            return bool(self.living("master")) and self.run("rosparam", "list", timeout=5).returncode == 0
        return False

    def _launch(self, robot: str) -> None:
        for process in self.living("launch"):
            if process.robot == robot:
                process.end()
        self.start("launch", "roslaunch", "jetbot_control_node", "jetbot_controller.launch", f"robot_name:={robot}",
                   f"i2c_bus:=fake:{self.folder}/{robot}", robot=robot)
        pid = self.wait(lambda: self.pid_of("jetbot_controller.py", f"/{robot}", "__name:=jetbot_controller"),
                        f"the controller of {robot}")
        launch = self.processes[-1]
        self.processes.append(Process("controller", launch.popen, (
            "rosrun", "jetbot_control_node", "jetbot_controller.py", f"__ns:={robot}",
            f"_i2c_bus:=fake:{self.folder}/{robot}"), robot, pid))
        self.wait(lambda: self.status(robot), f"a status of {robot}")

    def _adopt_last(self, program: str) -> None:
        """Note the process that rosrun has become."""
        last = self.processes[-1]
        last.pid = self.wait(lambda: self.pid_of(program), program)

    def pid_of(self, *words: str) -> Optional[int]:
        """Return the id of a process of this scene with these words in its command line."""
        for path in Path("/proc").glob("[0-9]*"):
            with contextlib.suppress(OSError):
                line = (path / "cmdline").read_text() + (path / "environ").read_text()
                if str(self.folder) in line and all(word in line for word in words) and "python" in line[:60]:
                    return int(path.name)
        return None

    def status(self, robot: str) -> str:
        """Return a robot's status, "" if it has none."""
        with contextlib.suppress(subprocess.TimeoutExpired):
            return self.run("rostopic", "echo", "-n", "1", f"/{robot}/jetbot_controller/status", timeout=5).stdout
        return ""

    def command(self, kind: str, robot: str) -> Process:
        """Start a commander of this kind for a robot."""
        topic, message = f"/{robot}/cmd_vel", TWIST % SPEEDS[kind]
        commands: Dict[str, Tuple[str, ...]] = {
            "order": ("rostopic", "pub", topic, "geometry_msgs/Twist", message),
            "repeat": ("rostopic", "pub", "-r", "10", topic, "geometry_msgs/Twist", message),
            "page": (sys.executable, str(ROOT / "tests/chaos/page.py"), str(self.page_port), f"/{robot}",
                     str(SPEEDS["page"])),
        }
        return self.start(kind, *commands[kind], robot=robot)

    def living(self, *kinds: str) -> List[Process]:
        """Return the processes of these kinds, of all if there is none, that run."""
        return [process for process in self.processes if (not kinds or process.kind in kinds) and process.alive()]

    def chip(self, process: Process) -> Path:
        """Return the file of a robot's motor board."""
        return self.folder / process.robot / "0x60"

    def wheels(self, robot: str) -> Tuple[float, float]:
        """Return the speeds (left, right) that the motor board of a robot gives its motors."""
        with contextlib.suppress(OSError):
            return wheel_speeds(str(self.folder / robot))
        return 0.0, 0.0  # unplugged: no power

    def wait(self, condition: Callable, what: str, within: float = START_TIMEOUT):
        """Return the condition's value once it is true; raise AssertionError after this many seconds."""
        deadline = time.monotonic() + within
        while True:
            value = condition()
            if value or time.monotonic() > deadline:
                assert value, f"waited {within} s for {what}"
                return value
            time.sleep(0.02)

    def close(self) -> List[str]:
        """End all processes; return the command lines of those of this scene that are left."""
        for kinds in ("order", "repeat", "page", "second"), ("launch", "cockpit"), ("master",):
            for process in self.living(*kinds):
                process.end()
        deadline = time.monotonic() + 5
        while self._left() and time.monotonic() < deadline:
            time.sleep(0.1)
        return self._left()

    def _left(self) -> List[str]:
        left = []
        for path in Path("/proc").glob("[0-9]*"):
            with contextlib.suppress(OSError):
                if f"ROS_HOME={self.folder}\0" in (path / "environ").read_text():
                    left.append((path / "cmdline").read_text().replace("\0", " "))
        return left
