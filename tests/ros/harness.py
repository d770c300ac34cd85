"""What the tests share: real processes against the test's own master, a fake bus, and waiting for conditions."""

import contextlib
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import rospy
import rostest
from geometry_msgs.msg import Twist
from roslib.packages import find_node
from std_msgs.msg import Bool, String

from jetbot.fake.motors import STILL, wheel_speeds

START = 15.0  # seconds that a process may take until it works; generous, for slow machines
END = 45.0    # seconds that it may take to end: roslaunch ends its nodes one after the other


def program(package, name):
    """The path of a package's program, as rosrun finds it, without the half second that rosrun takes."""
    return find_node(package, name)[0]


CONTROLLER = program("jetbot_control_node", "jetbot_controller.py")


class RobotTest(unittest.TestCase):
    """Each test has a fake bus of its own, and leaves no process behind."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="jetbot_")
        self.bus = os.path.join(self.folder, "bus")
        self.processes = []
        for node in ("/jetbot_controller", "/jetbot_motion_control", "/jetbot_simulator"):
            if rospy.has_param(node):
                rospy.delete_param(node)  # parameters outlive their node

    def tearDown(self):
        for process in reversed(self.processes):
            end(process)
        self.wait_for(lambda: not users(self.folder), START, f"the processes that use {self.folder} to end")
        shutil.rmtree(self.folder)

    def start(self, *command, **options):
        """A process in a group of its own, its output in ``process.log``."""
        log = Path(self.folder, f"log_{len(self.processes)}")
        with log.open("w") as file:
            process = subprocess.Popen(command, stdout=file, stderr=file, start_new_session=True, **options)
        process.log = log
        self.processes.append(process)
        return process

    def controller(self, **parameters):
        """The controller on the fake bus, subscribed."""
        process = self.start(CONTROLLER, f"_i2c_bus:=fake:{self.bus}",
                             *(f"_{name}:={value}" for name, value in parameters.items()))
        self.wait_for_controller()
        return process

    def wait_for_controller(self):
        """Wait until the controller listens to this test's commands."""
        self.wait_for(lambda: self.commands().get_num_connections(), START, "the controller to subscribe")

    def launch(self, package, file, *arguments, **options):
        """roslaunch on the fake bus."""
        return self.start("roslaunch", package, file, f"i2c_bus:=fake:{self.bus}", *arguments, **options)

    def commands(self):
        """The test's own publisher of commands, made when first asked for."""
        if not hasattr(self, "_commands"):
            self._commands = rospy.Publisher("cmd_vel", Twist, queue_size=1)
            self.addCleanup(self._commands.unregister)
        return self._commands

    def command(self, linear, angular=0.0):
        """Publish one command."""
        self.commands().publish(twist(linear, angular))

    def emergency_stop(self, engaged):
        """Publish an emergency stop, or its release, and let it stand for those who join later."""
        if not hasattr(self, "_emergency"):
            self._emergency = rospy.Publisher("/emergency_stop", Bool, queue_size=1, latch=True)
            self.addCleanup(self._emergency.unregister)
        self._emergency.publish(engaged)

    def publisher(self, linear=0.5, rate=10):
        """A process that publishes commands, as a pupil would start it."""
        return self.start("rostopic", "pub", "-r", str(rate), "/cmd_vel", "geometry_msgs/Twist",
                          f"{{linear: {{x: {linear}}}}}")

    def wheels(self):
        """The speeds (left, right) of the wheels on the fake bus, in [-1, 1]."""
        return wheel_speeds(self.bus)

    def wait_for(self, condition, within, what):
        """Wait until the condition is true; fail when it does not become so within these seconds."""
        deadline = time.monotonic() + within
        while not condition():
            if time.monotonic() > deadline:
                self.fail(f"waited {within} s for {what}; wheels {self.wheels()}{self.logs()}")
            time.sleep(0.01)

    def wait_for_wheels(self, left, right, within=5.0):
        """Wait until the wheels turn at these speeds; fail after ``within`` seconds, here and below."""
        self.wait_for(lambda: near(self.wheels(), (left, right)), within, f"the wheels to turn at {left}, {right}")

    def wait_for_stop(self, within):
        self.wait_for(lambda: self.wheels() == STILL, within, "the wheels to stop")

    def wheels_stay(self, left, right, for_seconds):
        """Fail as soon as the wheels do anything else."""
        deadline = time.monotonic() + for_seconds
        while time.monotonic() < deadline:
            self.assertTrue(near(self.wheels(), (left, right)), f"the wheels turn at {self.wheels()}{self.logs()}")
            time.sleep(0.01)

    def status(self):
        """A list of the controller's status texts, which grows as they come."""
        texts = []
        subscriber = rospy.Subscriber("/jetbot_controller/status", String, lambda message: texts.append(message.data))
        self.addCleanup(subscriber.unregister)
        return texts

    def wait_for_status(self, texts, text, within=5.0):
        self.wait_for(lambda: texts and texts[-1] == text, within, f"the status {text!r} after {texts}")

    def logs(self):
        """What all processes of this test have printed so far."""
        return "".join(f"\n--- {process.args}\n{read(process)}" for process in self.processes)


def users(folder):
    """The command lines of all processes that name the folder."""
    commands = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(FileNotFoundError, ProcessLookupError):  # those that have just ended
            commands.append(path.read_text())
    return [command for command in commands if folder in command]


def read(process):
    """What the process has printed so far."""
    return process.log.read_text()


def end(process):
    """End the process: politely, then by force; with all of its group."""
    if process.poll() is None:
        for signal_number in (signal.SIGCONT, signal.SIGINT):
            os.killpg(process.pid, signal_number)
    try:
        process.wait(END)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def twist(linear, angular=0.0):
    """A Twist: m/s ahead, rad/s to the left."""
    message = Twist()
    message.linear.x, message.angular.z = linear, angular
    return message


def near(speeds, wanted):
    """Whether speeds are those that were wanted, but for the steps in which a board counts."""
    return all(abs(speed - want) < 0.001 for speed, want in zip(speeds, wanted))


def main(test_case):
    """Run the tests of a case under rostest."""
    name = os.path.splitext(os.path.basename(sys.argv[0]))[0]
    rospy.init_node("test_" + name)
    rostest.rosrun("jetbot_tests", name, test_case)
