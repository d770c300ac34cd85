"""Checks of the motion: the commands that arrive, and the wheels, on the fake bus or on a real robot."""

import sys
import time
from functools import partial
from typing import Callable, Dict, Optional, Tuple

import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist
from std_msgs.msg import String

from jetbot import fake
from jetbot.boards import BOARDS
from jetbot.fake.motors import STOPPED, wheel_speeds
from jetbot.wait import wait_until
from jetbot_tools.terminal import choose

from . import Problem

TOPIC = "/cmd_vel"
RATE_WINDOW = 1.5        # s in which the rate is measured
RATE_TOLERANCE = 0.1     # fraction of the rate
KEY_TIMEOUT = 20.0       # s for the user to press a key
SPEED, TURN = 0.3, 0.1   # m/s and rad/s, of the command that tests the wheels
SPEED_TOLERANCE = 0.005  # of full power; less than a step of any board
COMMAND_INTERVAL = 0.05  # s
RESPONSE_TIMEOUT = 1.5   # s for the wheels to respond, or a publisher to connect
SHOW_TIME = 1.0          # s that a real robot's wheels turn
REPORT_TIMEOUT = 5.0     # s for the controller to report

Wheels = Callable[[], Tuple[float, float]]  # returns the speeds of the left and the right wheel


def init_node() -> None:
    """Make this process a node, unless it is one already; a master must be running."""
    if not rospy.core.is_initialized():
        rospy.init_node("check_lesson", anonymous=True, disable_signals=True)


def check_rate(package: str, rate: float, fix: str) -> Problem:
    """Return the problem, or None if the package, the only publisher, sends ``rate`` commands a second."""
    init_node()
    times = []
    subscriber = rospy.Subscriber(TOPIC, Twist, lambda twist: times.append(time.monotonic()))
    time.sleep(RATE_WINDOW)
    subscriber.unregister()
    measured = (len(times) - 1) / (times[-1] - times[0]) if len(times) > 1 else 0
    if abs(measured - rate) <= RATE_TOLERANCE * rate:
        return None
    return f"{package} publishes {measured:.1f} times a second, not {rate}: {fix}"


def check_key(node: str) -> Problem:
    """Return the problem, or None if the keyboard's node sends a forward command once its user is asked for one."""
    init_node()
    senders = set()
    subscriber = rospy.Subscriber(
        TOPIC, Twist, lambda twist: twist.linear.x > 0 and senders.add(twist._connection_header["callerid"]))
    wait_until(subscriber.get_num_connections, RESPONSE_TIMEOUT)
    print(f"Click into the terminal of {node}, and keep i pressed.", flush=True)
    if wait_until(lambda: node in senders, KEY_TIMEOUT):
        return None
    return f"No forward command came from {node}: click into its terminal, then press i"


def check_wheels_obey() -> Problem:
    """Return the problem, or None if the wheels turn at a command and stop at the next; ask a real robot's user."""
    init_node()
    motors = motor_diagnostics()
    wheels = fake_wheels(motors)
    publisher = rospy.Publisher(TOPIC, Twist, queue_size=1)
    try:
        problem = _check_fake_wheels(publisher, wheels) if wheels else _check_real_wheels(publisher)
        return problem and f"The wheels do not follow the command: {problem}{_reason(motors)}"
    finally:
        publisher.publish(Twist())
        publisher.unregister()


def _check_fake_wheels(publisher: rospy.Publisher, wheels: Wheels) -> Problem:
    return _check_command(publisher, wheels, SPEED, TURN) or _check_command(publisher, wheels, 0, 0)


def _check_command(publisher: rospy.Publisher, wheels: Wheels, x: float, z: float) -> Problem:
    wanted = x - z, x + z  # the workshop's mix

    def obeyed():
        return all(abs(speed - want) < SPEED_TOLERANCE for speed, want in zip(wheels(), wanted))

    if _drive(publisher, x, z, obeyed):
        return None
    return "at x {} and z {} they turn at {:.2f} and {:.2f}, not {:.2f} and {:.2f}".format(x, z, *wheels(), *wanted)


def _check_real_wheels(publisher: rospy.Publisher) -> Problem:
    if not (sys.stdin and sys.stdout):  # closed
        raise EOFError
    input(f"Put the robot on a box, wheels in the air. They turn for {SHOW_TIME:.0f} s. Enter starts, Ctrl-C cancels. ")
    _drive(publisher, SPEED, 0, lambda: False, SHOW_TIME)
    _drive(publisher, 0, 0, lambda: True)
    if choose("Did both wheels turn forward, and stop?", {"yes": True, "no": False}):
        return None
    return "run rosrun jetbot_control_node doctor.py, then calibrate.py"


def _drive(publisher, x, z, condition, timeout=RESPONSE_TIMEOUT) -> bool:
    """Command x (m/s) and z (rad/s) until the condition is true; return whether it becomes true in time (s)."""
    twist = Twist()
    twist.linear.x, twist.angular.z = x, z
    return wait_until(lambda: publisher.publish(twist) or condition(), timeout, COMMAND_INTERVAL)


def check_wheels_turn() -> Problem:
    """Return the problem, or None if the robot drives at another node's commands."""
    init_node()
    motors = motor_diagnostics()
    wheels = fake_wheels(motors)
    if wait_until(lambda: status().startswith("driving") and not (wheels and wheels() == STOPPED), RESPONSE_TIMEOUT):
        return None
    return f"The wheels do not turn{_reason(motors)}"


def motor_diagnostics() -> Dict[str, str]:
    """Return what the controller reports about its motors on /diagnostics; raise ROSException if it names no bus."""
    motors = {}
    subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, lambda array: motors.update(
        {pair.key: pair.value for report in array.status if report.name == "jetbot_controller: motors"
         for pair in report.values}))
    reported = wait_until(lambda: "bus" in motors and motors.get("board") in BOARDS, REPORT_TIMEOUT)
    subscriber.unregister()
    if not reported:
        raise rospy.ROSException("the controller reports no bus on /diagnostics")
    return motors


def fake_wheels(motors: Dict[str, str]) -> Optional[Wheels]:
    """Return the fake robot's wheels; None for a real robot. motors: as ``motor_diagnostics`` returns it."""
    folder = fake.folder_of(motors["bus"])
    return partial(wheel_speeds, folder, motors["board"], motors.get("address")) if folder else None


def status() -> str:
    """Return the controller's status text; raise ROSException if none arrives."""
    return rospy.wait_for_message("/jetbot_controller/status", String, REPORT_TIMEOUT).data


def _reason(motors) -> str:
    """Return the end of a sentence: the status that the controller reports, and what to do about it."""
    text, settings = status(), motors.get("settings", "")
    if "emergency" in text:
        cure = "; release it with rostopic pub -1 /emergency_stop std_msgs/Bool false"
    elif "from" in settings:
        cure = f"; it has {settings}: start it without that file"
    else:
        cure = "; was it started with a parameter such as invert_left?" if text.startswith("driving") else ""
    return f", and the controller reports {text!r}{cure}"
