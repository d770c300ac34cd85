"""Checks of the wheels, on the fake bus or on a real robot."""

import contextlib
from functools import partial
from typing import Callable, Iterator, Optional, Tuple

import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist
from std_msgs.msg import String

from jetbot import fake
from jetbot.fake.motors import STOPPED, wheel_speeds
from jetbot.wait import wait_until
from jetbot_tools.terminal import choose

from . import Problem
from .commands import TOPIC, init_node

SPEED = 0.3              # m/s, of the command that tests the wheels
COMMAND_INTERVAL = 0.05  # s
RESPONSE_TIMEOUT = 1.5   # s for the wheels to respond
SHOW_TIME = 1.0          # s that a real robot's wheels turn
REPORT_TIMEOUT = 5.0     # s for the controller to report

Speeds = Tuple[float, float]


def check_wheels_obey() -> Problem:
    """Return the problem, or None if the wheels turn at a command and stop at the next; ask a real robot's user."""
    init_node()
    wheels = fake_wheels()
    return _check_fake_wheels(wheels) if wheels else _check_real_wheels()


def _check_fake_wheels(wheels: Callable[[], Speeds]) -> Problem:
    with commander() as drive:
        for speed, obeyed in (SPEED, lambda: min(wheels()) > 0), (0, lambda: wheels() == STOPPED):
            if not drive(speed, obeyed):
                return _not_obeyed(f"at x {speed} they turn at {format_speeds(wheels())}")
    return None


def _check_real_wheels() -> Problem:
    input(f"Put the robot on a box, wheels in the air. They turn for {SHOW_TIME:.0f} s. Enter starts, Ctrl-C cancels. ")
    with commander() as drive:
        drive(SPEED, lambda: False, SHOW_TIME)
    if choose("Did both wheels turn forward, and stop?", {"yes": True, "no": False}):
        return None
    return _not_obeyed("run rosrun jetbot_control_node doctor.py, then calibrate.py")


@contextlib.contextmanager
def commander() -> Iterator[Callable[..., bool]]:
    """Yield drive(speed, condition, timeout), and stop the robot at the end.

    drive commands a forward speed in m/s until the condition is true, and returns whether it became true in time (s).
    """
    publisher = rospy.Publisher(TOPIC, Twist, queue_size=1)

    def drive(speed, condition, timeout=RESPONSE_TIMEOUT):
        twist = Twist()
        twist.linear.x = speed
        return wait_until(lambda: publisher.publish(twist) or condition(), timeout, COMMAND_INTERVAL)

    try:
        yield drive
    finally:
        publisher.publish(Twist())
        publisher.unregister()


def check_wheels_turn() -> Problem:
    """Return the problem, or None if the robot drives at another node's commands."""
    init_node()
    wheels = fake_wheels()
    if wait_until(lambda: status() == "driving" and not (wheels and wheels() == STOPPED), RESPONSE_TIMEOUT):
        return None
    return f"The wheels do not turn{_reason()}"


def fake_wheels() -> Optional[Callable[[], Speeds]]:
    """Return a function that returns the fake robot's wheel speeds (left, right); None for a real robot."""
    board, bus = robot()
    folder = fake.folder_of(bus)
    return partial(wheel_speeds, folder, board) if folder else None


def robot() -> Tuple[str, str]:
    """Return the (board, bus) that the controller reports on /diagnostics; ROSException where it reports none."""
    motors = {}
    subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, lambda array: motors.update(
        {pair.key: pair.value for report in array.status if report.name == "jetbot_controller: motors"
         for pair in report.values}))
    wait_until(lambda: "bus" in motors, REPORT_TIMEOUT)
    subscriber.unregister()
    if "bus" not in motors:
        raise rospy.ROSException("the controller reports no bus on /diagnostics")
    return motors["board"], motors["bus"]


def status() -> str:
    """Return the controller's status text; ROSException where none comes."""
    return rospy.wait_for_message("/jetbot_controller/status", String, REPORT_TIMEOUT).data


def format_speeds(speeds: Speeds) -> str:
    """Return the wheel speeds as text."""
    return " and ".join(f"{speed:.2f}" for speed in speeds)


def _not_obeyed(detail: str) -> str:
    return f"The wheels do not follow the command: {detail}{_reason()}"


def _reason() -> str:
    """Return the end of a sentence: the status that the controller reports."""
    text = status()
    release = "; release it with rostopic pub -1 /emergency_stop std_msgs/Bool false" if "emergency" in text else ""
    return f", and the controller reports {text!r}{release}"
