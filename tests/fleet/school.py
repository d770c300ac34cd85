"""A class of robots, each whole in a host of its own, and the computers of teachers and pupils."""

import json
import os
import shutil
import signal
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Dict, List

from class_page import Page
from network import Host, Router
from wheels import Wheels

from jetbot.wait import wait_until
from jetbot_cockpit.remote import identity
from jetbot_cockpit.remote.fleet import Entry, Fleet
from jetbot_cockpit.remote.identity import Identity
from processes import end

CLASS = "7b"
HUB = Path(__file__).parents[2] / "morbot_ws/src/jetbot_cockpit/scripts/hub.py"
START_TIMEOUT = 120.0  # s, for all robots at two cores
STARTING = 5           # robots that start at once
BACK = 5.0             # s, in which all is well again once the link is
COMPUTERS = {"laptop": 101, "second_laptop": 102, "tablet": 103, "stranger": 104}  # their addresses
OF_ROS = ("ROS_MASTER_URI", "ROS_IP", "ROS_LOG_DIR", "ROS_NAMESPACE")


class Robot:
    """A robot, named jetbot_NN: its host, its home, its bus."""

    def __init__(self, router: Router, folder: Path, number: int, key_of):
        self.name, self._router, self.number = f"jetbot_{number:02}", router, number
        self.folder, self.bus = folder / self.name, folder / self.name / "bus"
        self.cookie = f"{self.name}{43 * '0'}"
        self.folder.mkdir()
        self.be(Identity(self.name, CLASS, key_of(self.name)))
        codes = self.folder / ".ros/morbot_classes" / CLASS
        codes.mkdir(parents=True, mode=0o700)
        (codes / "codes.json").write_text(json.dumps({self.name: [f"ABCD{number:02}".translate(LETTERS), self.cookie]}))
        self.host = Host(router, self.name, number)

    def be(self, own: Identity) -> None:
        """Write who this robot is."""
        identity.write(own, str(self.folder / ".ros/morbot_robot.json"))

    def start(self) -> None:
        """Start what a real robot starts with its computer."""
        self.host.start(["roslaunch", "jetbot_class", "robot.launch", f"robot:={self.name}", "camera:=false",
                         f"i2c_bus:=fake:{self.bus}"], self.folder / "log", environment(self.folder))

    def switch_off(self) -> None:
        """Take the power from the computer and the wheels."""
        self.host.kill()
        shutil.rmtree(self.bus)
        self.host.close()

    def reboot(self) -> None:
        """Switch on a robot that was switched off."""
        self.host = Host(self._router, self.name, self.number)
        self.start()


LETTERS = str.maketrans("01", "XY")  # which no code has


def environment(home: Path) -> Dict[str, str]:
    """Return the environment of programs with this home."""
    return {**{name: value for name, value in os.environ.items() if name not in OF_ROS}, "HOME": str(home),
            "ROS_HOME": str(home / ".ros"), "ROS_HOSTNAME": "localhost", "PYTHONUNBUFFERED": "1"}


class Hub:
    """A hub on a teacher's computer. Closed, it is gone."""

    def __init__(self, host: Host, folder: Path):
        self.host, self._folder = host, folder
        self.start()

    def start(self) -> None:
        command = [sys.executable, str(HUB), "--class", CLASS, "--classes", str(self._folder)]
        self._process = self.host.start(command, self._folder / f"hub_of_{self.host.name}",
                                        environment(self._folder))
        assert wait_until(lambda: "http://" in self.log(), 20.0), self.log()

    def log(self) -> str:
        return self._process.log.read_text()

    def page(self) -> Page:
        """Return a new page of a teacher."""
        return Page(self.host)

    def signal(self, signum: int) -> None:
        os.killpg(self._process.pid, signum)

    def freeze(self) -> None:
        self.signal(signal.SIGSTOP)

    def thaw(self) -> None:
        self.signal(signal.SIGCONT)

    def kill(self) -> None:
        self.signal(signal.SIGKILL)
        self._process.wait()

    def close(self) -> None:
        end([self._process])


class School:
    """So many robots of one class, a hub on the laptop, and the other computers of COMPUTERS."""

    def __init__(self, folder: Path, count: int):
        self.folder = folder
        self.fleet = Fleet(str(folder / "laptop"), CLASS)
        self.router = Router()
        self.robots = [Robot(self.router, folder, number, self.fleet.key_of) for number in range(1, count + 1)]
        self.computers = {name: Host(self.router, name, number) for name, number in COMPUTERS.items()}
        self.list_robots()
        self.wheels = Wheels({robot.name: robot.bus for robot in self.robots})
        self.wheels.start()
        with ThreadPoolExecutor(STARTING) as pool:
            list(pool.map(self._start, self.robots))
        self.hub = Hub(self.computers["laptop"], folder / "laptop")

    def _start(self, robot: Robot) -> None:
        robot.start()
        assert wait_until(lambda: self.is_served(robot), START_TIMEOUT, 0.2), (robot.folder / "log").read_text()

    def is_served(self, robot: Robot) -> bool:
        """Return whether the robot's page can be opened, and its controller answers."""
        page = self.tablet(robot)
        try:
            return wait_until(lambda: page.robot(robot.name).get("answers"), 1.0)
        finally:
            page.close()

    def list_robots(self) -> None:
        """Write the list of robots that a hub reads, by the addresses that they have now."""
        self.fleet.save([Entry(robot.name, robot.host.address) for robot in self.robots])
        self.fleet.update()

    def tablet(self, robot: Robot) -> Page:
        """Return a new page of the robot's pupil, directly at the robot."""
        return Page(self.computers["tablet"], robot.host.address, robot.cookie)

    def hosts(self) -> List[Host]:
        """Return all computers, the robots' first."""
        return [*(robot.host for robot in self.robots), *self.computers.values()]

    def recover(self) -> None:
        """Repair all links; go on once the hub has all robots again, and no stop is engaged."""
        for host in self.hosts():
            host.spoil()
            host.set_link("up")
        self.hub.thaw()
        page = self.hub.page()
        try:
            page.wait(lambda: self.answer(page), 60.0, "all robots")
            page.send(type="release")
            page.wait(lambda: not self.stopped(page), 10.0, "the release")
            page.wait(lambda: not any(page.robot(robot.name)["driver"] for robot in self.robots), 10.0, "free robots")
        finally:
            page.close()
        assert wait_until(lambda: not any(self.wheels.turn(robot.name) for robot in self.robots), 5.0), "wheels turn"

    def answer(self, page: Page) -> bool:
        """Return whether a page has all robots."""
        return all(page.robot(robot.name).get("answers") for robot in self.robots)

    def stopped(self, page: Page) -> List[str]:
        """Return the robots that a page shows as stopped."""
        return [robot.name for robot in self.robots if "emergency_stop" in page.robot(robot.name).get("holds", ())]

    def close(self) -> None:
        """Switch all off."""
        self.wheels.end()
        hosts = self.hosts()
        for host in hosts:
            host.kill()
        for host in hosts:
            host.close()
        self.router.close()
