#!/usr/bin/env python3
"""ROS node: drives a JetBot as cmd_vel says, stops it when it must not move, and tells why."""

# ruff: noqa: E402
import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C during the start simply ends it; Python's handler might lose it

import math
import os
import re
import sys
import threading
import time
from collections import deque

import rospy
from diagnostic_msgs.msg import DiagnosticStatus
from diagnostic_updater import Updater
from geometry_msgs.msg import Twist
from std_msgs.msg import Bool, String

from jetbot import BusError, InvalidValue, JetbotError, Robot
from jetbot.fake.bus import default_folder
from jetbot.kinematics import mix
from jetbot_ros.master import require_master
from jetbot_ros.parameters import checked, load
from jetbot_ros.safety import Safety

WATCH_PERIOD = 0.03       # seconds between two looks at what may stop the robot
FAREWELL = 2.0            # seconds for the node to end once the robot stands
DEFAULT_FAILSAFE = 1.0    # seconds, for a board with a timer, where cmd_vel_timeout is 0
REPORT_PERIOD = 0.1       # seconds
DIAGNOSTICS_PERIOD = 1.0  # seconds
REPEAT_LOG = 1.0          # seconds before the same line is logged again


class Controller:
    """Where commands, emergency stop and watch meet on the robot, under one lock. Nothing moves before the watch."""

    def __init__(self, robot, cmd_vel_timeout, wheel_separation, max_speed):
        self.geometry = wheel_separation, max_speed
        self.safety = Safety(cmd_vel_timeout)
        self.robot = robot
        self.fault = None  # the BusError, while the board does not answer
        self.exit_code = 1  # until the watch has ended well
        self.status = None
        self.news = deque(maxlen=10)
        self.commands = 0
        self._ending = False
        self._watching = False
        self._launcher = os.getppid() if launched() else None
        self._lock = threading.Lock()
        self._status_topic = rospy.Publisher("~status", String, latch=True, queue_size=1)
        rospy.Subscriber("/emergency_stop", Bool, self._on_emergency_stop, queue_size=1, tcp_nodelay=True)
        self._cmd_vel = rospy.Subscriber("cmd_vel", Twist, self._on_command, queue_size=1, tcp_nodelay=True)

    def _on_command(self, twist):
        with self._lock:
            self.commands += 1
            self.safety.command(twist.linear.x, twist.angular.z, time.monotonic())
            if not self.fault:
                self._drive(idle=False)

    def _on_emergency_stop(self, message):
        with self._lock:
            self.safety.emergency_stop(message.data)
            self._drive(idle=False)

    def end(self, *_):
        """End the watch soon; fit to be a signal's handler."""
        self._ending = True

    def watch(self):
        """Look after the robot until the end, then stop it, then end the node.

        Neither logs nor asks the master: a terminal or a network may hold up who does.
        """
        try:
            self._watching = True
            while not self._is_over():
                with self._lock:
                    self.safety.watch(self._cmd_vel.get_num_connections(), time.monotonic())
                    self._drive(idle=True)
                self.robot.heartbeat()
                time.sleep(WATCH_PERIOD)
        finally:
            with self._lock:
                self._watching = False
            self._close()
        self.exit_code = 1 if self.fault else 0

    def _is_over(self):
        orphaned = self._launcher is not None and os.getppid() != self._launcher
        return self._ending or orphaned or rospy.is_shutdown()

    def _close(self):
        try:
            self.robot.close()
            self.fault = None
        except BusError as fault:
            self.fault = fault
        finally:
            self._end_node()

    def _end_node(self):
        self._status_topic.publish("stopped: the controller has ended")
        give_up = threading.Timer(FAREWELL, os._exit, [1])  # where the master or the terminal hangs
        give_up.daemon = True
        give_up.start()
        rospy.signal_shutdown("the robot stands")

    def _drive(self, idle):
        """Bring the wheels to what is allowed now, and the board and this node to one mind."""
        if not self._watching:
            return
        try:
            self.robot.set_motors(*mix(*self.safety.velocity, *self.geometry))
            self.robot.refresh(idle)
            self.fault = None
        except BusError as fault:
            self.fault = fault
        self._tell()

    def _tell(self):
        status = f"stopped: {self.fault.reason}, trying again" if self.fault else self.safety.reason
        if status != self.status:
            self.status = status
            self._status_topic.publish(status)
            self.news.append((status, self.fault or self.safety.alarm))


def launched():
    """Whether roslaunch started this node, whose end then is the node's, too."""
    return any(argument.startswith("__log:=") for argument in sys.argv)


class Report:
    """What the node says of itself: log lines and /diagnostics, from the main thread, which may wait."""

    def __init__(self, controller, parameters):
        self._controller = controller
        self._parameters = parameters
        self._logged = {}  # status: when
        self._last = None
        name = rospy.get_namespace().strip("/")
        self._prefix = f"{name}: " if name else ""
        self._counted = (0, time.monotonic())
        self._updater = Updater()
        self._updater.setHardwareID(controller.robot.driver.link.name)
        self._updater.add("motors", self._diagnose)

    def spin(self):
        """Report until the node ends."""
        due = 0
        while not rospy.is_shutdown():
            while self._controller.news:
                self._log(*self._controller.news.popleft())
            if self._controller.status:
                self._log(self._controller.status, self._controller.fault or self._controller.safety.alarm)
            if time.monotonic() >= due:
                due = time.monotonic() + DIAGNOSTICS_PERIOD
                self._updater.force_update()
            time.sleep(REPORT_PERIOD)

    def _log(self, status, alarm):
        now = time.monotonic()
        if status != self._last and now - self._logged.get(status, -math.inf) >= REPEAT_LOG:
            self._logged[status] = now
            self._last = status
            (rospy.logwarn if alarm else rospy.loginfo)(self._prefix + status)

    def _diagnose(self, result):
        controller, link = self._controller, self._controller.robot.driver.link
        now = time.monotonic()
        level = (DiagnosticStatus.ERROR if controller.fault else
                 DiagnosticStatus.WARN if controller.safety.alarm else DiagnosticStatus.OK)
        result.summary(level, controller.status or "starting")
        result.add("board", self._parameters["board"])
        result.add("bus", link.name)
        result.add("transfers", link.transfers)
        result.add("failed transfers", link.errors)
        (commands, since), self._counted = self._counted, (controller.commands, now)
        result.add("commands per second", f"{(controller.commands - commands) / (now - since):.1f}")
        at = controller.safety.commanded_at
        result.add("age of the last command (s)", "none yet" if at is None else f"{now - at:.2f}")
        return result


def check_namespace(namespace):
    """Raise InvalidValue for a namespace that ROS's own programs in C++ refuse."""
    if not re.fullmatch(r"/([A-Za-z]\w*/)*", namespace, re.ASCII):
        raise InvalidValue(f"a robot cannot be named {namespace.strip('/')}",
                           "Begin with a letter, and use letters, digits and _.")


def read_parameters():
    """All parameters: those of this node, then those of the configuration file, then the defaults."""
    given = rospy.get_param("~", {})
    return checked({**load(given.pop("config", None)), **given})


def make_robot(parameters):
    """The Robot that the parameters describe; where its board measures how it moves, published from now on."""
    names = ("board", "i2c_bus", "port", "left_motor_alpha", "right_motor_alpha", "swap_motors", "invert_left",
             "invert_right", "min_duty")
    options = {name: parameters[name] for name in names}
    if options["i2c_bus"] == "fake":
        options["i2c_bus"] = f"fake:{default_folder(rospy.get_namespace())}"
    robot = Robot(**options, failsafe=parameters["cmd_vel_timeout"] or DEFAULT_FAILSAFE)
    if hasattr(robot.driver, "listen"):
        from jetbot_ros.odometry import OdometryPublisher  # here, since most robots have no such board
        robot.driver.listen(OdometryPublisher(parameters["publish_tf"]))
    return robot


def main():
    require_master()
    # rospy's own signal handlers talk to the master before anything stops, and wait for ever if that hangs.
    rospy.init_node("jetbot_controller", disable_signals=True)
    parameters = read_parameters()
    check_namespace(rospy.get_namespace())
    names = ("cmd_vel_timeout", "wheel_separation", "max_speed")
    controller = Controller(make_robot(parameters), *(parameters[name] for name in names))
    for ending in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(ending, controller.end)
    watch = threading.Thread(target=controller.watch)
    watch.start()
    try:
        Report(controller, parameters).spin()
    finally:
        controller.end()
        watch.join()
    return controller.exit_code


if __name__ == "__main__":
    try:
        sys.exit(main())
    except JetbotError as error:
        rospy.logfatal(error)
        sys.exit(1)
    except OSError:
        require_master()  # it may have ended meanwhile
        raise
