"""The life of the controller's node: it starts with one clear error at most, and stops the robot at its end."""

import os
import signal
import threading
import time
from typing import Callable, Collection, Dict, List

import rospy

from jetbot import JetbotError, Robot, fake
from jetbot.boards import find_board
from jetbot.lock import lock_board
from jetbot.supply import find_supply
from jetbot_ros.command_line import private_parameters
from jetbot_ros.master import is_registered, register

from . import watch
from .notes import Observer
from .parameters import PARAMETERS, resolve
from .ramp import make_ramp
from .report import Report
from .safety import State
from .supervisor import Supervisor
from .supply_watch import SupplyWatch
from .wheels import WheelsPublisher

SHUTDOWN_TIMEOUT = 2.0  # s for the node to end once the robot is stopped


def read_parameters() -> Dict[str, object]:
    """Return the node's parameters: typed ones, then those of the file, then the defaults. Raise InvalidValue."""
    return resolve(private_parameters(rospy.get_name(), rospy.get_param("~", {}), [*PARAMETERS, "config"]))


def make_robot(parameters: Dict[str, object]) -> Robot:
    """Return the Robot that the parameters describe. If its board measures its motion, publish that from now on.

    Raise JetbotError, also if another program drives that board.
    """
    names = ("board", "i2c_address", "left_motor_alpha", "right_motor_alpha", "swap_motors", "invert_left",
             "invert_right", "min_duty", "max_duty", "pwm_frequency")
    places = {name: fake.expand(str(parameters[name]), rospy.get_namespace()) for name in ("i2c_bus", "port")}
    board = find_board(parameters["board"], parameters["i2c_address"])
    lock = lock_board(board.place(**places), board.address)  # before Robot() stops the wheels, which may be another's
    robot = Robot(**{name: parameters[name] for name in names}, **places)
    robot.lock = lock  # until this process ends
    if robot.driver.closed_loop:
        from .odometry import TelemetryPublisher  # here: most robots have no such board
        robot.driver.listen(TelemetryPublisher(parameters["publish_tf"]))
    return robot


def watch_supply(robot: Robot, parameters: Dict[str, object]) -> SupplyWatch:
    """Return what watches the robot's supply. If something measures it, publish that from now on."""
    supply = find_supply(robot.driver.link)
    supply_watch = SupplyWatch(supply, parameters["acceleration_limit"])
    if supply:
        from .battery import publish_supply  # here: on many robots nothing measures it
        publish_supply(supply, supply_watch)
    return supply_watch


def make_supervisor(robot: Robot, parameters: Dict[str, object], drive: Callable[[float, float], None],
                    senders: Callable[[], Collection[str]], on_change: Callable[[State], None],
                    *observers: Observer) -> Supervisor:
    """Return the Supervisor, with ``~wheels``, and with the ramp and the odometry that the parameters ask for."""
    wheels = WheelsPublisher(robot.driver, drive)
    observers += (wheels,)
    if parameters["publish_odom"] and not robot.driver.closed_loop:
        from .open_loop import OpenLoopOdometry  # here: most robots do without
        observers += (OpenLoopOdometry(robot, parameters),)
    return Supervisor(robot, wheels.drive, parameters["cmd_vel_timeout"], senders, on_change, observers,
                      make_ramp(parameters, robot.driver))


def run(supervisor: Supervisor, report: Report) -> int:
    """Drive and report until the node ends, then stop the robot. Return the exit code.

    Raise JetbotError for what ended it, such as a lack of file descriptors.
    """
    for signum in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(signum, supervisor.end)
    watch.start(supervisor, watch.MasterWatch(is_registered, register))
    failures, ended, unregistered = [], threading.Event(), threading.Event()
    threading.Thread(target=give_up, args=[ended], daemon=True).start()  # now: at the end, no thread may be left
    rospy.core.add_shutdown_hook(lambda _: unregistered.set())  # rospy calls it last
    threading.Thread(target=supervise, args=[supervisor, report, failures, ended], daemon=True).start()
    try:
        report.spin(supervisor)
    finally:
        supervisor.end()
        ended.wait()         # the robot is stopped;
        unregistered.wait()  # after that, give_up limits the time
    for failure in failures:
        raise failure
    return 0 if supervisor.closed else 1


def supervise(supervisor: Supervisor, report: Report, failures: List[JetbotError], ended: threading.Event) -> None:
    """Drive until the node ends, then end it; note what went wrong, but log nothing: the terminal may block."""
    try:
        supervisor.run(rospy.is_shutdown)
    except JetbotError as failure:
        failures.append(failure)
    finally:
        ended.set()
        report.end()
        rospy.signal_shutdown("the robot is stopped")


def give_up(ended: threading.Event) -> None:
    """End the process some time after the robot's end, if the master or the terminal hangs."""
    ended.wait()
    time.sleep(SHUTDOWN_TIMEOUT)
    os._exit(1)
