"""Checks of a robot that drives, on the fake bus or a real one."""

import time

import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist
from std_msgs.msg import String

from jetbot.fake_motors import wheel_speeds
from jetbot.terminal import choose

from .graph import publishers

TOPIC = "/cmd_vel"
SPEED = 0.3        # m/s, of a command that tries the wheels
TRY = 2.0          # seconds for the wheels to obey
SHOW = 1.0         # seconds that a real robot's wheels turn
LISTEN = 1.5       # seconds in which the rate is measured
TOLERANCE = 0.1    # part of the rate
KEY_WAIT = 20.0    # seconds for somebody to press a key
NEWS = 5.0         # seconds for the controller to tell of itself
STILL = (0.0, 0.0)


def join():
    """Become a node, if this process is none yet."""
    if not rospy.core.is_initialized():
        rospy.init_node("check_lesson", anonymous=True, disable_signals=True)


def wheels_obey():
    """Whether the wheels turn at a command and stand at the next; at a real robot, its owner is asked."""
    join()
    board, bus = robot()
    if bus.startswith("fake:"):
        return fake_wheels_obey(lambda: wheel_speeds(bus[len("fake:"):], board))
    return real_wheels_obey()


def fake_wheels_obey(wheels):
    """wheels: a function that returns the speeds (left, right)."""
    with Commander() as commander:
        if not commander.drive(SPEED, lambda: min(wheels()) > 0):
            return not_obeyed(f"at x {SPEED} they turn at {told(wheels())}")
        if not commander.drive(0, lambda: wheels() == STILL):
            return not_obeyed(f"at x 0 they turn at {told(wheels())}")
    return None


def real_wheels_obey():
    input(f"Put the robot on a box, wheels in the air. They will turn for {SHOW:.0f} s. Enter starts it, Ctrl-C ends. ")
    with Commander() as commander:
        end = time.monotonic() + SHOW
        commander.drive(SPEED, lambda: time.monotonic() > end)
    seen = choose("Did both wheels turn forward, and stop?", {"y": True, "n": False})
    return None if seen else not_obeyed("see what rosrun jetbot_control_node doctor.py finds, then calibrate.py")


class Commander:
    """A publisher of commands, which leaves the robot standing."""

    def __enter__(self):
        self._topic = rospy.Publisher(TOPIC, Twist, queue_size=1)
        return self

    def drive(self, linear, done):
        """Command this speed ahead until done() is true, for ``TRY`` seconds at most; whether it was."""
        twist = Twist()
        twist.linear.x = linear
        deadline = time.monotonic() + TRY
        while not done():
            if time.monotonic() > deadline:
                return False
            self._topic.publish(twist)
            time.sleep(0.05)
        return True

    def __exit__(self, *_):
        self._topic.publish(Twist())
        self._topic.unregister()


def wheels_turn():
    """Whether the robot drives as somebody else commands it."""
    join()
    board, bus = robot()
    deadline = time.monotonic() + TRY
    while time.monotonic() < deadline:
        if status() == "driving" and (not bus.startswith("fake:") or wheel_speeds(bus[len("fake:"):], board) != STILL):
            return None
    return not_obeyed("they stand")


def publishes_at(package, rate):
    """Whether the package's node publishes ``rate`` commands a second."""
    join()
    nodes = publishers(package, TOPIC)
    times = [when for when, node in heard(LISTEN) if node in nodes]
    if len(times) < 2:
        return f"No geometry_msgs/Twist comes from {nodes[0]} on {TOPIC}: does it publish again and again?"
    measured = (len(times) - 1) / (times[-1] - times[0])
    if abs(measured - rate) <= TOLERANCE * rate:
        return None
    return f"{nodes[0]} publishes {measured:.1f} times a second, not {rate}: use rospy.Rate({rate})"


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
    join()
    pressed = []
    rospy.Subscriber(TOPIC, Twist, lambda twist: pressed.append(
        twist.linear.x > 0 and twist._connection_header["callerid"] == node))
    print(f"Click into the terminal of {node}, and keep i pressed.", flush=True)
    deadline = time.monotonic() + KEY_WAIT
    while not any(pressed):
        if time.monotonic() > deadline:
            return f"No command ahead came from {node}: click into its terminal, then press i"
        time.sleep(0.05)
    return None


def robot():
    """The (board, bus) of the running controller, by its own word."""
    deadline = time.monotonic() + NEWS
    while time.monotonic() < deadline:
        for told in rospy.wait_for_message("/diagnostics", DiagnosticArray, NEWS).status:
            values = {pair.key: pair.value for pair in told.values}
            if told.name == "jetbot_controller: motors" and "bus" in values:
                return values["board"], values["bus"]
    raise rospy.ROSException("the controller does not tell on /diagnostics which bus it is on")


def status():
    """What the controller says it does."""
    return rospy.wait_for_message("/jetbot_controller/status", String, NEWS).data


def not_obeyed(how):
    return f"The wheels do not obey: {how}, and the controller says {status()!r}"


def told(speeds):
    return " and ".join(f"{speed:.2f}" for speed in speeds)
