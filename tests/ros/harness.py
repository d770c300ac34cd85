"""What the tests share: real processes under the test's own master, a fake bus, and conditions to wait for."""

import contextlib
import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path
from typing import Callable, List, Optional, Tuple

import rosgraph
import rospy
from geometry_msgs.msg import Twist
from roslib.packages import find_node
from std_msgs.msg import Bool, String

from jetbot.fake.motors import STOPPED, wheel_speeds
from jetbot.wait import wait_until
from jetbot_ros.master import NO_ANSWER, address_of, ask, proxy
from processes import SHUTDOWN_TIMEOUT, end, free_port, start  # noqa: F401 (tests import them from here)

SHORT = 5.0  # s; what takes less is a bound that a robot keeps, and no mere end of this test's patience
LOOK_INTERVAL, LONGEST_LOOK = 0.01, 0.02  # s
START_TIMEOUT = 60  # s for processes to start and to end; thirty controllers of another test may start meanwhile


def program(package: str, name: str) -> str:
    """Return the path of a package's program, as rosrun finds it, without rosrun's 0.5 s of CPU time."""
    return find_node(package, name)[0]


signal.signal(signal.SIGHUP, signal.SIG_DFL)  # for the programs that tests start, also below nohup, which ignores it
CONTROLLER = program("jetbot_control_node", "jetbot_controller.py")
COCKPIT = program("jetbot_cockpit", "cockpit.py")


class RobotTest(unittest.TestCase):
    """A test with a fake bus of its own, which leaves no process behind."""

    hardware = ", on a fake bus"  # the end of each status

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="jetbot_")
        self.bus = os.path.join(self.folder, "bus")
        self.processes = []
        self._emergency = rospy.Publisher("/emergency_stop", Bool, queue_size=1, latch=True)
        self.addCleanup(self._emergency.unregister)
        for name in rospy.get_param_names():  # parameters outlive their node
            if "/jetbot_" in name:
                rospy.delete_param(name)

    def tearDown(self):
        end(self.processes)
        self.wait_for(lambda: not find_processes(self.folder), START_TIMEOUT, f"the processes in {self.folder} to end")
        shutil.rmtree(self.folder)

    def start(self, *command: str, **options) -> subprocess.Popen:
        """Start a process in a group of its own; ``read`` returns what it prints. options: of subprocess.Popen."""
        self.processes.append(start(command, Path(self.folder, f"log_{len(self.processes)}"), **options))
        return self.processes[-1]

    def controller(self, **parameters) -> subprocess.Popen:
        """Start the controller on the fake bus with these parameters; wait until it subscribes."""
        process = self.start(CONTROLLER, f"_i2c_bus:=fake:{self.bus}",
                             *(f"_{name}:={value}" for name, value in parameters.items()))
        ready = self.commands().get_num_connections
        self.wait_for(lambda: ready() or process.poll() is not None, START_TIMEOUT, "the controller to subscribe")
        self.assertTrue(ready(), f"the controller has ended{self.logs()}")
        return process

    def cockpit(self, *arguments: str) -> Tuple[subprocess.Popen, int]:
        """Start the cockpit on a free port; return its process, once it serves the page, and the port."""
        process = self.start(COCKPIT, "_port:=0", *arguments)
        self.wait_for(lambda: "http://localhost:" in read(process), START_TIMEOUT, "the cockpit's address")
        return process, int(re.search(r"localhost:(\d+)", read(process))[1])

    def wait_for_controller(self) -> None:
        """Wait until the controller subscribes to this test's commands."""
        self.wait_for(self.commands().get_num_connections, START_TIMEOUT, "the controller to subscribe")

    def launch(self, package: str, file: str, *arguments: str, **options) -> subprocess.Popen:
        """Start roslaunch on the fake bus."""
        return self.start("roslaunch", package, file, f"i2c_bus:=fake:{self.bus}", *arguments, **options)

    def commands(self) -> rospy.Publisher:
        """Return this test's publisher on cmd_vel, created when first needed."""
        if not hasattr(self, "_commands"):
            self._commands = rospy.Publisher("cmd_vel", Twist, queue_size=1)
            self.addCleanup(self._commands.unregister)
        return self._commands

    def command(self, linear: float, angular: float = 0.0) -> None:
        """Publish one command, in m/s and rad/s."""
        self.commands().publish(twist(linear, angular))

    def drive_at(self, speed: float) -> None:
        """Publish one command, and wait until both wheels turn at this speed."""
        self.command(speed)
        self.wait_for_wheels(speed, speed)

    def emergency_stop(self, engaged: bool) -> None:
        """Publish an emergency stop or its release, latched for robots that start later."""
        self._emergency.publish(engaged)

    def publisher(self) -> subprocess.Popen:
        """Start a process that commands 0.5 m/s ten times per second."""
        return self.start("rostopic", "pub", "-r", "10", "/cmd_vel", "geometry_msgs/Twist", "{linear: {x: 0.5}}")

    def wheels(self) -> Tuple[float, float]:
        """Return the speeds (left, right) of the wheels on the fake bus, in [-1, 1]."""
        return wheel_speeds(self.bus)

    def wait_for(self, condition: Callable[[], object], within: float, what: str) -> None:
        """Fail unless the condition becomes true within this many seconds; what: its description."""
        if not becomes_true(condition, within):
            self.fail(f"waited {within} s for {what}; wheels {self.wheels()}{self.logs()}")

    def wait_for_wheels(self, left: float, right: float, within: float = 5.0) -> None:
        """Fail unless the wheels reach these speeds within this many seconds."""
        self.wait_for(lambda: near(self.wheels(), (left, right)), within, f"the wheels to turn at {left}, {right}")

    def wait_for_stop(self, within: float) -> None:
        """Fail unless both wheels stop within this many seconds."""
        self.wait_for(lambda: self.wheels() == STOPPED, within, "the wheels to stop")

    def wheels_stay(self, left: float, right: float, for_seconds: float) -> None:
        """Fail if the wheels leave these speeds within this many seconds."""
        if wait_until(lambda: not near(self.wheels(), (left, right)), for_seconds):
            self.fail(f"the wheels turn at {self.wheels()}{self.logs()}")

    def record(self, topic: str, message_type: type, field: Callable = lambda message: message) -> list:
        """Return a list of the topic's messages, or of a field of them, which grows as they arrive."""
        values = []
        subscriber = rospy.Subscriber(topic, message_type, lambda message: values.append(field(message)))
        self.addCleanup(subscriber.unregister)
        return values

    def status(self) -> List[str]:
        """Return a list of the controller's status texts, which grows as they arrive."""
        return self.record("/jetbot_controller/status", String, lambda message: message.data)

    def wait_for_status(self, texts: List[str], text: str, within: float = 5.0) -> None:
        """Fail unless this, on this test's hardware, becomes the last of the status texts within this many seconds."""
        self.wait_for(lambda: texts and texts[-1] == text + self.hardware, within, f"the status {text!r} after {texts}")

    def logs(self) -> str:
        """Return what all processes of this test have printed so far."""
        return "".join(f"\n--- {process.args}\n{read(process)}" for process in self.processes)


class SharedRobotTest(RobotTest):
    """Tests on one fake bus, whose processes ``setUpClass`` starts once, by the methods of ``shared``."""

    @classmethod
    def setUpClass(cls) -> None:
        cls.shared = RobotTest("setUp")
        cls.shared.setUp()
        cls.addClassCleanup(cls.shared.doCleanups)
        cls.addClassCleanup(cls.shared.tearDown)

    def setUp(self):
        super().setUp()
        self.bus = self.shared.bus

    def logs(self) -> str:
        return self.shared.logs() + super().logs()


def becomes_true(condition: Callable[[], object], within: float) -> bool:
    """Return whether the condition becomes true within this many seconds of a computer that has time.

    A short time counts at most LONGEST_LOOK per look at the condition: a busy computer that is late here is late for
    the robot, too.
    """
    if within >= SHORT:
        return wait_until(condition, within)
    passed, now = 0.0, time.monotonic()
    while not condition():
        if passed > within:
            return False
        time.sleep(LOOK_INTERVAL)
        before, now = now, time.monotonic()
        passed += min(now - before, LONGEST_LOOK)
    return True


def find_processes(text: str) -> List[int]:
    """Return the ids of the processes with this text in their command line."""
    ids = []
    for path in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):  # it has just ended
            if text in (path / "cmdline").read_text():
                ids.append(int(path.name))
    return ids


def pid(node: str) -> Optional[int]:
    """Return the process id that a node reports; None for a node that does not answer."""
    with contextlib.suppress(*NO_ANSWER):
        return ask(proxy(address_of(node)), "getPid")
    return None


def publishers(topic: str) -> List[str]:
    """Return the names of the nodes that publish on a topic, by the master."""
    return dict(rosgraph.Master(rospy.get_name()).getSystemState()[0]).get(topic, [])


def read(process: subprocess.Popen) -> str:
    """Return what the process has printed so far."""
    return process.log.read_text()


def twist(linear: float, angular: float = 0.0) -> Twist:
    """Return a Twist: m/s ahead, rad/s to the left."""
    message = Twist()
    message.linear.x, message.angular.z = linear, angular
    return message


def near(speeds: Tuple[float, float], wanted: Tuple[float, float]) -> bool:
    """Return whether the speeds are those wanted, to the steps in which a board counts."""
    return all(abs(speed - want) < 0.001 for speed, want in zip(speeds, wanted))
