"""Checks of the motion: the commands that arrive, and the wheels, on the fake bus or on a real robot."""

import time
from functools import partial
from typing import Callable, Dict, List, Optional, Tuple

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import Twist

from jetbot import fake
from jetbot.boards import BOARDS
from jetbot.fake.motors import STOPPED, wheel_speeds
from jetbot.wait import wait_until
from jetbot_ros import contract
from jetbot_ros.state import DRIVING, EMERGENCY_STOP, OWN_EMERGENCY_STOP, RobotState, read
from jetbot_tools.terminal import YES_OR_NO, choose

from . import Problem

RATE_WINDOW = 1.5        # s in which the rate is measured
RATE_TOLERANCE = 0.1     # fraction of the rate
KEY_TIMEOUT = 20.0       # s for the user to press a key
SPEED_TOLERANCE = 0.005  # of full power; less than a step of any board
RESPONSE_TIMEOUT = 1.5   # s for the wheels to respond, or a publisher to connect
REPORT_TIMEOUT = 5.0     # s for the controller to report
MAX_TURN = 0.2           # of full power, in lesson 3's exercise: turn on the spot, to the right, and slowly
MIN_TURN = 0.01          # of full power; less may turn no wheel
EXAMPLE = "for example '{angular: {z: -0.05}}'"
REPEAT = "repeat your command ten times per second with rostopic pub -r 10"

Wheels = Callable[[], Tuple[float, float]]  # returns the speeds of the left and the right wheel


def init_node() -> None:
    """Make this process a node, unless it is one already; a master must be running."""
    if not rospy.core.is_initialized():
        rospy.init_node("check_lesson", anonymous=True, disable_signals=True)


def check_rate(sender: str, rate: float, fix: str, topic: str) -> Problem:
    """Return the problem, or None if the only publisher of the topic sends ``rate`` commands a second."""
    times = [moment for moment, _ in record_commands(topic)]
    measured = (len(times) - 1) / (times[-1] - times[0]) if len(times) > 1 else 0
    if abs(measured - rate) <= RATE_TOLERANCE * rate:
        return None
    often = f"{measured:.1f} times a second" if measured else "at most once a second" if times else "nothing"
    return f"{sender} publishes {often}, not {rate} times a second: {fix}"


def check_power(topic: str) -> Problem:
    """Return the problem, or None if the next command, in the workshop's units, is one that the wheels can obey."""
    command = rospy.wait_for_message(topic, Twist, RESPONSE_TIMEOUT)
    x, z = command.linear.x, command.angular.z
    if abs(x) + abs(z) <= 1:
        return None
    return (f"Your program commands linear.x {x:g} and angular.z {z:g}, and a wheel has no more than full power, 1: "
            "x - z and x + z must be between -1 and 1")


def record_commands(topic: str) -> List[Tuple[float, Twist]]:
    """Return the commands of RATE_WINDOW seconds, each with its time in s; among them one that is latched."""
    init_node()
    commands = []
    subscriber = rospy.Subscriber(topic, Twist, lambda twist: commands.append((time.monotonic(), twist)))
    time.sleep(RATE_WINDOW)
    subscriber.unregister()
    return commands


def check_key(node: str, topic: str) -> Problem:
    """Return the problem, or None if the keyboard's node sends a forward command once its user is asked for one."""
    init_node()
    senders = set()
    subscriber = rospy.Subscriber(
        topic, Twist, lambda twist: twist.linear.x > 0 and senders.add(twist._connection_header["callerid"]))
    wait_until(subscriber.get_num_connections, RESPONSE_TIMEOUT)
    print(f"Click into the terminal of {node}, and keep i pressed.", flush=True)
    if wait_until(lambda: node in senders, KEY_TIMEOUT):
        return None
    return f"No forward command came from {node}: click into its terminal, then press i"


def check_turn(namespace: str = "") -> Problem:
    """Return the problem, or None if the one program that publishes sends lesson 3's command, and the wheels obey."""
    commands = [twist for _, twist in record_commands(f"{namespace}/cmd_vel")]
    if not commands:
        return f"The program that publishes on {namespace}/cmd_vel sends nothing: stop it with Ctrl-C, and {REPEAT}"
    command = commands[-1]
    problem = check_command(command.linear.x, command.angular.z)
    if not problem and len(commands) == 1:
        problem = f"Your command arrives only once: stop it with Ctrl-C, and {REPEAT}"
    return problem or _check_wheels_obey(namespace, command.linear.x, command.angular.z)


def check_command(x: float, z: float) -> Problem:
    """Return the problem, or None if this command, linear.x and angular.z, is that of lesson 3's exercise."""
    if x:
        return (f"Your command has linear.x {x:g}, so the robot drives {'forward' if x > 0 else 'backward'}: "
                "leave linear.x at 0, and it turns on the spot")
    if z > 0:
        return f"Your command has angular.z {z:g}, which turns the robot to the left: write a number below 0"
    if z > -MIN_TURN:
        return f"Your command has angular.z {z:g}, which turns no wheel: write {-MIN_TURN} or less, {EXAMPLE}"
    if z < -MAX_TURN:
        return f"Your command has angular.z {z:g}, which is fast: write a number between {-MAX_TURN} and 0, {EXAMPLE}"
    return None


def _check_wheels_obey(namespace: str, x: float, z: float) -> Problem:
    """Return the problem, or None if the wheels turn as commanded at this moment; ask a real robot's user."""
    motors = motor_diagnostics(namespace)
    wheels, wanted = fake_wheels(motors), (x - z, x + z)  # the workshop's mix
    if not wheels:
        return _ask_what_it_does()
    if wait_until(lambda: all(abs(speed - want) < SPEED_TOLERANCE for speed, want in zip(wheels(), wanted)),
                  RESPONSE_TIMEOUT):
        return None
    return ("The wheels do not follow your command: at x {:g} and z {:g} they turn at {:.2f} and {:.2f}, "
            "not {:.2f} and {:.2f}{}".format(x, z, *wheels(), *wanted, _reason(namespace, motors)))


def _ask_what_it_does() -> Problem:
    if choose("Does the robot turn on the spot, to the right (the left wheel forward)?", YES_OR_NO):
        return None
    return "The wheels do not follow your command: run rosrun jetbot_tools doctor.py, then calibrate.py"


def check_wheels_turn(namespace: str = "") -> Problem:
    """Return the problem, or None if the robot drives at another node's commands."""
    init_node()
    motors = motor_diagnostics(namespace)
    wheels = fake_wheels(motors)
    if wait_until(lambda: state_of(namespace).state == DRIVING and not (wheels and wheels() == STOPPED),
                  RESPONSE_TIMEOUT):
        return None
    return f"The wheels do not turn{_reason(namespace, motors)}"


def motor_diagnostics(namespace: str = "") -> Dict[str, str]:
    """Return what the controller reports about its motors on /diagnostics; raise ROSException if it names no bus."""
    motors, name = {}, f"{namespace}/{contract.CONTROLLER}: motors".lstrip("/")
    subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, lambda array: motors.update(
        {pair.key: pair.value for report in array.status if report.name == name
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


def state_of(namespace: str = "") -> RobotState:
    """Return the robot's state; raise ROSException if none arrives."""
    return read(rospy.wait_for_message(f"{namespace}/{contract.STATE}", DiagnosticStatus, REPORT_TIMEOUT))


def _reason(namespace: str, motors: Dict[str, str]) -> str:
    """Return the end of a sentence: the state that the controller reports, and what to do about it."""
    state, settings = state_of(namespace), motors.get("settings", "")
    if {EMERGENCY_STOP, OWN_EMERGENCY_STOP} & {*state.holds}:
        cure = f"; release it with rostopic pub -1 {contract.STOP} std_msgs/Bool false"
    elif "from" in settings:
        cure = f"; it has {settings}: start it without that file"
    else:
        cure = "; was it started with a parameter such as invert_left?" if state.state == DRIVING else ""
    return f", and the controller reports {state.sentence!r}{cure}"
