"""Checks of which node commands the robot, and at which rate."""

import time
from typing import List, Tuple

import rospy
from geometry_msgs.msg import Twist

from jetbot.wait import wait_until
from jetbot_ros.master import require_master

from . import Problem
from .graph import own_publishers

TOPIC = "/cmd_vel"
RATE_WINDOW = 1.5      # s in which the rate is measured
RATE_TOLERANCE = 0.1   # fraction of the rate
CONNECT_TIMEOUT = 2.0  # s to connect to the publishers
KEY_TIMEOUT = 20.0     # s for the user to press a key


def init_node() -> None:
    """Make this process a node, if it is none yet; SystemExit without a master."""
    require_master()
    if not rospy.core.is_initialized():
        rospy.init_node("check_lesson", anonymous=True, disable_signals=True)


def check_rate(package: str, rate: float, fix: str) -> Problem:
    """Return the problem, or None if one node of the package publishes ``rate`` commands a second."""
    init_node()
    nodes = own_publishers(package, TOPIC)
    if len(nodes) > 1:
        return f"{nodes[1]} of {package} publishes, too: stop it with Ctrl-C in its terminal"
    times = [when for when, node in record(RATE_WINDOW) if node in nodes]
    if len(times) < 2:
        return f"{package} does not publish {rate} times a second: {fix}"
    measured = (len(times) - 1) / (times[-1] - times[0])
    if abs(measured - rate) <= RATE_TOLERANCE * rate:
        return None
    return f"{nodes[0]} publishes {measured:.1f} times a second, not {rate}: {fix}"


def record(seconds: float) -> List[Tuple[float, str]]:
    """Return the commands of this time: for each when it came (monotonic, s) and which node sent it."""
    commands = []
    subscriber = rospy.Subscriber(
        TOPIC, Twist, lambda twist: commands.append((time.monotonic(), twist._connection_header["callerid"])))
    time.sleep(seconds)
    subscriber.unregister()
    return commands


def check_key(node: str) -> Problem:
    """Return the problem, or None if the keyboard's node sends a forward command once its user is asked for one."""
    init_node()
    senders = set()
    subscriber = rospy.Subscriber(
        TOPIC, Twist, lambda twist: twist.linear.x > 0 and senders.add(twist._connection_header["callerid"]))
    wait_until(subscriber.get_num_connections, CONNECT_TIMEOUT)
    print(f"Click into the terminal of {node}, and keep i pressed.", flush=True)
    if wait_until(lambda: node in senders, KEY_TIMEOUT):
        return None
    return f"No forward command came from {node}: click into its terminal, then press i"
