"""The life of the controller's node: it starts with one clear error at most, and stops the robot at its end."""

import os
import signal
import threading
import time
from typing import Dict, List, Sequence, Tuple

import rospy

from jetbot import JetbotError, fake
from jetbot.boards import find_board
from jetbot.connection import locate, lock_board
from jetbot.health_sensors import Computer
from jetbot.robot import Robot
from jetbot.supply import find_supply
from jetbot.wait import wait_until
from jetbot_ros import failures
from jetbot_ros.links import Links
from jetbot_ros.node_parameters import private_parameters

from .control import watch
from .control.supervisor import Supervisor
from .odometry.wheels import WheelsPublisher
from .parameters import PARAMETERS, resolve
from .status.health_watch import HealthWatch
from .status.report import Report
from .supply.supply_watch import SupplyWatch

MASTER_TIMEOUT = 1.5    # s for an answer of the master, until the robot is stopped
SHUTDOWN_TIMEOUT = 2.0  # s for the node to end once the robot is stopped
STOP_TIMEOUT = 0.5      # s for the robot to be stopped when something in this process broke; then its guard stops it


def read_parameters() -> Dict[str, object]:
    """Return the node's parameters: typed ones, then those of the file, then the defaults. Raise InvalidValue."""
    return resolve(private_parameters(rospy.get_name(), rospy.get_param("~", {}), [*PARAMETERS, "config"]))


def make_robot(parameters: Dict[str, object]) -> Robot:
    """Return the Robot that the parameters describe. Raise JetbotError, also if another program drives that board."""
    names = ("board", "i2c_address", "left_motor_alpha", "right_motor_alpha", "swap_motors", "invert_left",
             "invert_right", "min_duty", "max_duty", "pwm_frequency")
    places = {name: fake.expand(str(parameters[name]), rospy.get_namespace()) for name in ("i2c_bus", "port")}
    board = find_board(parameters["board"], parameters["i2c_address"])
    lock = lock_board(locate(board, **places), board.address)  # before Robot() stops the wheels, which may be another's
    robot = Robot(**{name: parameters[name] for name in names}, **places)
    robot.lock = lock  # until this process ends
    return robot


def geometry_of(robot: Robot, parameters: Dict[str, object]) -> Tuple[float, ...]:
    """Return what ``mix`` needs; a board that controls its wheel speeds itself takes a Twist unchanged."""
    return () if robot.driver.closed_loop else (parameters["wheel_separation"], parameters["max_speed"])


def start_reporting(supervisor: Supervisor, parameters: Dict[str, object], geometry: Sequence[float]) -> Report:
    """Return the Report on the robot. What it gets, measures and does is published from now on.

    geometry: as of ``geometry_of``.
    """
    supply = find_supply(supervisor.robot.driver.link)
    supply_watch = SupplyWatch(supply, parameters["acceleration_limit"])
    supervisor.watchers += [supply_watch, WheelsPublisher(supervisor.robot.driver, geometry)]
    if supply:
        from .supply.battery import publish_supply  # here: on many robots nothing measures it
        publish_supply(supply, supply_watch)
    publish_odometry(supervisor, parameters)
    return Report(parameters, supervisor, supply_watch, watch_health(supervisor.robot, supply_watch))


def watch_health(robot: Robot, supply_watch: SupplyWatch) -> HealthWatch:
    """Return how the robot is. Its computer is read from now on; a robot on fake hardware has none."""
    health = HealthWatch(supply_watch)
    if not fake.folder_of(robot.driver.link.name):
        ended = threading.Event()
        rospy.on_shutdown(ended.set)
        threading.Thread(target=health.run, args=[Computer().read, ended.wait], daemon=True).start()
    return health


def publish_odometry(supervisor: Supervisor, parameters: Dict[str, object]) -> None:
    """From now on, publish where the robot is: if its board measures that, or if the parameters ask for it."""
    robot = supervisor.robot
    if robot.driver.closed_loop:
        from .odometry.publishers import TelemetryPublisher  # here: most robots have no such board
        robot.driver.listen(TelemetryPublisher(parameters["publish_tf"]))
    elif parameters["publish_odom"]:
        from .odometry.publishers import OpenLoopOdometry  # here: most robots do without
        supervisor.watchers.append(OpenLoopOdometry(robot, parameters))


def run(supervisor: Supervisor, report: Report) -> int:
    """Drive and report until the node ends, then stop the robot. Return the exit code.

    Raise JetbotError for what ended it, such as a lack of file descriptors.
    """
    for signum in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(signum, supervisor.end)
    failures.before_end.append(lambda: (supervisor.end(), wait_until(lambda: supervisor.closed, STOP_TIMEOUT)))
    rospy.on_shutdown(supervisor.end)  # another node has taken this one's name
    watch.start(supervisor, Links(MASTER_TIMEOUT).heal)
    errors, ended, unregistered = [], threading.Event(), threading.Event()
    threading.Thread(target=give_up, args=[ended], daemon=True).start()  # now: at the end, no thread may be left
    rospy.core.add_shutdown_hook(lambda _: unregistered.set())  # rospy calls it last
    threading.Thread(target=supervise, args=[supervisor, report, errors, ended], daemon=True).start()
    try:
        report.spin()
    finally:
        supervisor.end()
        ended.wait()         # the robot is stopped;
        unregistered.wait()  # after that, give_up limits the time
    for error in errors:
        raise error
    return 0 if supervisor.closed else 1


def supervise(supervisor: Supervisor, report: Report, errors: List[JetbotError], ended: threading.Event) -> None:
    """Drive until the node ends, then end it; note what went wrong, but log nothing: the terminal may block."""
    try:
        supervisor.run()
    except JetbotError as error:
        errors.append(error)
    finally:
        ended.set()
        report.end()
        rospy.signal_shutdown("the robot is stopped")


def give_up(ended: threading.Event) -> None:
    """End the process some time after the robot's end, if the master or the terminal hangs."""
    ended.wait()
    time.sleep(SHUTDOWN_TIMEOUT)
    os._exit(1)
