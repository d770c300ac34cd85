"""Checks of who commands the robot, and how often."""

import time

import rospy
from geometry_msgs.msg import Twist

from jetbot_ros.master import require_master

from .graph import own_publishers

TOPIC = "/cmd_vel"
LISTEN = 1.5       # seconds in which the rate is measured
TOLERANCE = 0.1    # part of the rate
CONNECT = 2.0      # seconds to connect to who publishes
KEY_WAIT = 20.0    # seconds for somebody to press a key


def become_node():
    """Become a node, if this process is none yet."""
    require_master()
    if not rospy.core.is_initialized():
        rospy.init_node("check_lesson", anonymous=True, disable_signals=True)


def soon(condition, within):
    """Wait until the condition is true; whether it became so within these seconds."""
    deadline = time.monotonic() + within
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.05)
    return True


def publishes_at(package, rate, remedy):
    """Whether the package's node publishes ``rate`` commands a second; remedy: what makes it do so."""
    become_node()
    nodes = own_publishers(package, TOPIC)
    if len(nodes) > 1:
        return f"{nodes[1]} of {package} publishes, too: end it with Ctrl-C in its terminal"
    times = [when for when, node in heard(LISTEN) if node in nodes]
    if len(times) < 2:
        return f"{package} does not publish {rate} times a second: {remedy}"
    measured = (len(times) - 1) / (times[-1] - times[0])
    if abs(measured - rate) <= TOLERANCE * rate:
        return None
    return f"{nodes[0]} publishes {measured:.1f} times a second, not {rate}: {remedy}"


def heard(seconds):
    """The commands of some seconds: for each the time, and the node that sent it."""
    commands = []
    subscriber = rospy.Subscriber(
        TOPIC, Twist, lambda twist: commands.append((time.monotonic(), twist._connection_header["callerid"])))
    time.sleep(seconds)
    subscriber.unregister()
    return commands


def key_pressed(node):
    """Whether the keyboard's node sends a command ahead, now that its user is asked to."""
    become_node()
    pressed = []
    subscriber = rospy.Subscriber(TOPIC, Twist, lambda twist: pressed.append(
        twist.linear.x > 0 and twist._connection_header["callerid"] == node))
    soon(subscriber.get_num_connections, CONNECT)
    print(f"Click into the terminal of {node}, and keep i pressed.", flush=True)
    if soon(lambda: any(pressed), KEY_WAIT):
        return None
    return f"No command ahead came from {node}: click into its terminal, then press i"
