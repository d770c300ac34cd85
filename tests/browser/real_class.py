"""A class of real robots: each with a ROS master, a controller and a cockpit of its own, and a hub without ROS."""

import os
import signal
import socket
import sys
from contextlib import suppress
from pathlib import Path
from subprocess import Popen
from typing import Dict

import yaml

from harness import START_TIMEOUT, program
from jetbot.wait import wait_until
from jetbot_cockpit.remote.fleet import Entry, Fleet
from jetbot_cockpit.remote.identity import Identity, write
from processes import end, free_port, start

from .browser_processes import descendants, is_running, send_signal
from .wheels import Speeds, WheelRecord

CLASS = "7b"


class RealClass:
    """robots: their names. folder: empty, for all their files."""

    def __init__(self, folder: Path, *robots: str):
        self.robots, self._folder = robots, folder
        self._ports = {robot: free_port() for robot in robots}
        self._masters = {robot: free_port() for robot in robots}
        self._launched: Dict[str, Popen] = {}
        self.record = WheelRecord({robot: folder / robot / "bus" for robot in robots})
        fleet = Fleet(str(folder / "classes"), CLASS)
        fleet.save([Entry(robot, f"127.0.0.1:{self._ports[robot]}") for robot in robots])
        for robot in robots:
            self._prepare(robot, fleet.key_of(robot))
            self.start_robot(robot)
        self.port = free_port()
        self.hub = start([sys.executable, program("jetbot_cockpit", "hub.py"), "--class", CLASS, "--port",
                          str(self.port), "--classes", str(folder / "classes")], folder / "hub_log", env=self._env())
        self.wait_for(self._serves, "the hub")

    @property
    def address(self) -> str:
        """The hub's, for whoever sits at the teacher's computer."""
        return f"http://localhost:{self.port}/"

    def port_of(self, robot: str) -> int:
        """Return the port of a robot's own page."""
        return self._ports[robot]

    def _serves(self):
        with suppress(OSError), socket.create_connection(("localhost", self.port), 1.0):
            return True
        return False

    def _env(self, **more: str):
        return {**os.environ, "HOME": str(self._folder), "ROS_HOSTNAME": "localhost", **more}

    def _prepare(self, robot, key):
        home = self._folder / robot
        (home / ".ros").mkdir(parents=True)
        bus = {"i2c_bus": f"fake:{home / 'bus'}", "cmd_vel_timeout": 0}
        (home / ".ros/jetbot.yaml").write_text(yaml.safe_dump(bus))
        write(Identity(robot, CLASS, key), str(home / "identity.json"))

    def start_robot(self, robot: str) -> None:
        """Switch a robot on."""
        home = self._folder / robot
        own = {"HOME": str(home), "ROS_HOME": str(home / ".ros"),
               "ROS_MASTER_URI": f"http://localhost:{self._masters[robot]}"}
        self._launched[robot] = start(
            ["roslaunch", "-p", str(self._masters[robot]), "jetbot_class", "robot.launch", f"robot:={robot}",
             f"identity:={home / 'identity.json'}", f"cockpit_port:={self._ports[robot]}",
             f"classes:={home / 'classes'}", "pictures:=false", "camera:=false"],
            self._folder / f"{robot}_log", env=self._env(**own))

    def kill_robot(self, robot: str) -> None:
        """Switch a robot off: no program of it says goodbye."""
        launched = self._launched[robot]
        nodes = descendants(launched.pid)
        send_signal([launched.pid, *nodes], signal.SIGKILL)
        launched.wait()
        assert wait_until(lambda: not any(map(is_running, nodes)), START_TIMEOUT), f"{robot} does not end"

    def wheels(self, robot: str) -> Speeds:
        """Return the speeds (left, right) of a robot's wheels."""
        return self.record.speeds(robot)

    def wait_for(self, condition, what: str, within: float = START_TIMEOUT) -> None:
        """Fail unless the condition becomes true within this many seconds."""
        assert wait_until(condition, within), f"waited {within} s for {what}; wheels " \
            f"{[self.wheels(robot) for robot in self.robots]}{self.logs()}"

    def logs(self) -> str:
        """Return what all have printed."""
        logs = [each.log for each in (self.hub, *self._launched.values())]
        return "".join(f"\n--- {log.name}\n{log.read_text()}" for log in logs)

    def close(self) -> None:
        """End all."""
        self.record.close()
        end([self.hub, *self._launched.values()])
