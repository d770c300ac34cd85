"""A ROS master, robots on fake buses and a cockpit, all of them real processes that end with the test."""

import json
import os
import re
import signal
import subprocess
import time
from contextlib import contextmanager
from pathlib import Path
from typing import Callable, Iterator, List
from urllib.request import Request, urlopen

import rosgraph

from harness import CONTROLLER, START_TIMEOUT, program
from jetbot.fake.motors import STOPPED
from jetbot.wait import wait_until
from jetbot_ros.state import MANUAL_PRIORITY
from processes import end, free_port, start

from .wheels import Speeds, WheelRecord

NAME = "class.test"  # a name of this computer that needs a code; the browsers of the tests resolve it to 127.0.0.1
LONGEST_GAP = 0.2    # s between two turns of a page, above which the switch may rightly fire
OBEY_TIMEOUT = 2.0   # s until what a person does has moved a robot
LOOK_INTERVAL = 0.05  # s between two looks, as each may ask the master or a page
STOP_TIMEOUT = 0.7   # s; the cockpit's switch fires after 0.3 s; the rest is for a busy computer
TRIES = 5            # on a busy computer
NODE_SHUTDOWN = 10.0  # s, until a node that hangs while it ends is killed

Condition = Callable[[float, float], bool]  # for the speeds left, right


def moving(left: float, right: float) -> bool:
    return (left, right) != STOPPED


class World:
    """robots: their names, which are namespaces. folder: empty, for their buses and logs."""

    def __init__(self, folder: Path, *robots: str):
        self._folder, self.robots, self._processes = folder, robots, []
        master, self.port = free_port(), free_port()
        self._uri = f"http://localhost:{master}"
        self._environment = {**os.environ, "ROS_MASTER_URI": self._uri, "ROS_HOME": str(folder), "HOME": str(folder)}
        self.record = WheelRecord({robot: folder / robot for robot in robots})
        try:
            self._start(master)
        except BaseException:
            self.close()
            raise

    def _start(self, master):
        self.start("rosmaster", "--core", "-p", str(master))
        self.wait_for(lambda: rosgraph.is_master_online(self._uri), START_TIMEOUT, "the ROS master")
        for robot in self.robots:
            bus = f"_i2c_bus:=fake:{self._folder / robot}"
            self.start(CONTROLLER, f"__ns:=/{robot}", bus, "_cmd_vel_timeout:=0")
            self.start(program("simulation", "simulator.py"), f"__ns:=/{robot}", bus)
        self.start_cockpit()
        for robot in self.robots:
            self.wait_for(lambda robot=robot: self._nodes(1, f"/{robot}/cmd_vel"), START_TIMEOUT, f"{robot}")

    def start(self, *command: str) -> subprocess.Popen:
        """Start a process of this world."""
        self._processes.append(start(command, self._folder / f"log_{len(self._processes)}", env=self._environment))
        return self._processes[-1]

    def start_cockpit(self) -> None:
        """Start the cockpit, and wait until it prints the addresses with the codes of a class."""
        self.cockpit = self.start(program("jetbot_cockpit", "cockpit.py"), f"_port:={self.port}", "_lan:=true",
                                  f"_name:={NAME}")
        self.record.watched = self.cockpit.pid
        self.wait_for(lambda: len(self.codes()) == 2, START_TIMEOUT, "the cockpit's codes")

    def codes(self) -> dict:
        """Return the addresses that the cockpit printed, by "teacher" and "pupil"."""
        urls = re.findall(rf"http://{NAME}:{self.port}/#\w+", self.cockpit.log.read_text())
        return {"teacher" if len(url.partition("#")[2]) == 10 else "pupil": url for url in urls}

    @property
    def address(self) -> str:
        """The cockpit's address for whoever sits at this computer: a teacher without a code."""
        return f"http://localhost:{self.port}/"

    def wheels(self, robot: str) -> Speeds:
        """Return the speeds (left, right) of a robot's wheels, from the registers of its fake chip."""
        return self.record.speeds(robot)

    def publishers(self, robot: str) -> List[str]:
        """Return the names of the nodes that publish commands for a robot."""
        return self._nodes(0, f"/{robot}/cmd_vel")

    def wait_for(self, condition: Callable[[], object], within: float, what: str) -> None:
        """Fail unless the condition becomes true within this many seconds; what: its description."""
        assert wait_until(condition, within, LOOK_INTERVAL), f"waited {within} s for {what}; wheels " \
            f"{[self.wheels(robot) for robot in self.robots]}{self._logs()}"

    def wait_until_free(self, robot: str) -> None:
        """Wait until a node's commands count: some time after the cockpit's last one."""
        used = [time.time()]

        def free():
            if self.publishers(robot):
                used[0] = time.time()
            return time.time() - used[0] > MANUAL_PRIORITY
        self.wait_for(free, START_TIMEOUT, "the cockpit to let go")

    def is_seen(self, robot: str) -> bool:
        """Return whether somebody looks through a robot's camera."""
        return bool(self._nodes(1, f"/{robot}/camera/image_raw/compressed"))

    def pictures(self, robot: str, label: str) -> List[Path]:
        """Return the pictures of a robot that were kept with this label."""
        return sorted((self._folder / "jetbot_pictures" / robot / label).glob("*.jpg"))

    @contextmanager
    def stops(self, *robots: str, what: str) -> Iterator[None]:
        """Fail unless what is done in this context stops these robots in time, and they stay stopped a while."""
        yield
        for robot in robots:
            self.wait_for_stop(robot, what)
        self.stay_stopped(*robots)

    def wait_for_stop(self, robot: str, what: str = "it was commanded") -> None:
        """Fail unless both wheels of a robot stop in time."""
        self.wait_for(lambda: self.wheels(robot) == STOPPED, STOP_TIMEOUT, f"{robot} to stop after {what}")

    def drive(self, page, robot: str, forward: float = 1.0, left: float = 0.0, wanted: Condition = moving) -> None:
        """Put a finger on the pad of a page, and leave it there once the wheels turn as wanted."""
        self.hold(page, lambda: page.touch(forward, left), page.lift, robot, wanted)

    def hold(self, page, press: Callable, let_go: Callable, robot: str, wanted: Condition = moving) -> None:
        """Press, and fail unless the wheels turn as wanted soon."""
        self.press_until(lambda: wanted(*self.wheels(robot)), page, press, let_go)

    def run(self, page, robot: str, wanted: Condition = moving) -> None:
        """Run a page's program, and fail unless the wheels turn as wanted soon after it has begun."""
        self.hold(page, page.start_program, lambda: page.click("#end"), robot, wanted)

    def drive_until(self, condition: Callable[[], object], page) -> None:
        """Put a finger on the pad of a page, and fail unless the condition becomes true soon."""
        self.press_until(condition, page, page.touch, page.lift)

    def press_until(self, condition: Callable[[], object], page, press: Callable, let_go: Callable) -> None:
        """Press, and fail unless the condition becomes true soon.

        Only if the page, the cockpit or this process paused, which lets the switch fire, let go, and press again.
        """
        for _ in range(TRIES):
            start = time.time()
            press()
            if wait_until(condition, OBEY_TIMEOUT, LOOK_INTERVAL):
                return
            if not self.paused(page, start):
                break
            let_go()
        raise AssertionError(
            f"the wheels turn at {[self.wheels(robot) for robot in self.robots]}, the page sent {page.sent()[-5:]}, "
            f"and shows {page.text_of('body')!r}{self._logs()}")

    def paused(self, page, start: float) -> bool:
        """Return whether page, cockpit or this process paused since then: the switch may fire, or a program may end."""
        return max(self.record.paused_at, page.paused_at()) > start or page.is_starved()

    def undisturbed(self, page, act: Callable) -> None:
        """Do this; only if it fails, and the page, the cockpit or this process paused meanwhile, do it again."""
        for tries_left in reversed(range(TRIES)):
            start = time.time()
            try:
                act()
                return
            except AssertionError:
                if not (tries_left and self.paused(page, start)):
                    raise

    def stay(self, wanted: Condition, *robots: str, for_seconds: float = 0.25) -> None:
        """Fail if the speeds (left, right) of the robots' wheels are not as wanted for this many seconds."""
        start = time.time()
        time.sleep(for_seconds)
        for robot in robots:
            seen = [self.wheels(robot), *(change.speeds for change in self.record.since(robot, start))]
            assert all(wanted(*speeds) for speeds in seen), f"{robot} turned its wheels at {seen}{self._logs()}"

    def stay_stopped(self, *robots: str, for_seconds: float = 0.25) -> None:
        """Fail if a wheel of a robot turns within this many seconds."""
        self.stay(lambda *wheels: wheels == STOPPED, *robots, for_seconds=for_seconds)

    def emergency_stop(self) -> None:
        """Stop all robots as ./morbot stop does."""
        assert self.start(program("jetbot_tools", "emergency_stop.py")).wait(START_TIMEOUT) == 0

    def delete_programs(self) -> None:
        """Delete what the pages of a test have kept: the next one's are alone, and have room."""
        for row in self._work(do="list", robot=None)["programs"]:
            if not row["deleted"]:
                self._work(do="delete", robot=row["robot"], id=row["id"])

    def publish_status(self, name: str, status: str) -> subprocess.Popen:
        """Start a node that publishes a controller's state in this namespace, as a controller, and nothing else."""
        return self.publish(f"/{name}/jetbot_controller/state", "diagnostic_msgs/DiagnosticStatus",
                            json.dumps({"message": status}), f"__ns:=/{name}", "__name:=jetbot_controller")

    def publish(self, topic: str, kind: str, message: str, *remappings: str) -> subprocess.Popen:
        """Start a node that publishes one message, latched, for as long as it lives."""
        return self.start("rostopic", "pub", "-l", topic, kind, message, *remappings)

    def kill(self, process: subprocess.Popen) -> None:
        """Kill a process, and wait for its end."""
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()

    def close(self) -> None:
        """End all processes."""
        self.record.close()
        end(self._processes[1:], within=NODE_SHUTDOWN)
        end(self._processes[:1], within=NODE_SHUTDOWN)  # the master, which the others still need

    def _work(self, **fields):
        headers = {"Content-Type": "application/json", "Origin": self.address.rstrip("/")}
        with urlopen(Request(f"{self.address}work", json.dumps(fields).encode(), headers), timeout=60) as answer:
            return json.load(answer)

    def _nodes(self, role, topic):
        """role: 0 publishers, 1 subscribers."""
        return dict(rosgraph.Master("/test", self._uri).getSystemState()[role]).get(topic, [])

    def _logs(self):
        return "".join(f"\n--- {process.args}\n{process.log.read_text()}" for process in self._processes)
