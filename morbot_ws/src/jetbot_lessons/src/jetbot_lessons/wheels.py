"""Checks of the wheels, on the fake bus or at a real robot."""

import time
from functools import partial

import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist
from std_msgs.msg import String

from jetbot.fake.motors import STILL, wheel_speeds
from jetbot.i2c import fake_folder
from jetbot_tools.terminal import choose

from .commands import TOPIC, become_node, soon

SPEED = 0.3        # m/s, of a command that tries the wheels
TRY = 1.5          # seconds for the wheels to obey
SHOW = 1.0         # seconds that a real robot's wheels turn
NEWS = 5.0         # seconds for the controller to tell of itself


def wheels_obey():
    """Whether the wheels turn at a command and stand at the next; at a real robot, its owner is asked."""
    become_node()
    wheels = fake_wheels()
    return fake_wheels_obey(wheels) if wheels else real_wheels_obey()


def fake_wheels_obey(wheels):
    """Whether the fake bus shows wheels that turn, then stand; wheels: a function that returns their speeds."""
    with Commander() as commander:
        if not commander.drive(SPEED, lambda: min(wheels()) > 0):
            return not_obeyed(f"at x {SPEED} they turn at {told(wheels())}")
        if not commander.drive(0, lambda: wheels() == STILL):
            return not_obeyed(f"at x 0 they turn at {told(wheels())}")
    return None


def real_wheels_obey():
    """Whether the robot's owner says that both wheels turned, then stood."""
    input(f"Put the robot on a box, wheels in the air. They will turn for {SHOW:.0f} s. Enter starts it, Ctrl-C ends. ")
    with Commander() as commander:
        end = time.monotonic() + SHOW
        commander.drive(SPEED, lambda: time.monotonic() > end)
    seen = choose("Did both wheels turn forward, and stop?", {"yes": True, "no": False})
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

        def obeyed():
            self._topic.publish(twist)
            return done()

        return soon(obeyed, TRY)

    def __exit__(self, *_):
        self._topic.publish(Twist())
        self._topic.unregister()


def wheels_turn():
    """Whether the robot drives as somebody else commands it."""
    become_node()
    wheels = fake_wheels()
    if soon(lambda: status() == "driving" and not (wheels and wheels() == STILL), TRY):
        return None
    return f"The wheels stand{reason()}"


def fake_wheels():
    """A function that returns the speeds (left, right) of the wheels on the fake bus; None for a real robot."""
    board, bus = robot()
    folder = fake_folder(bus)
    return partial(wheel_speeds, folder, board) if folder else None


def robot():
    """The (board, bus) of the running controller, by its own word."""
    deadline = time.monotonic() + NEWS
    while time.monotonic() < deadline:
        for report in rospy.wait_for_message("/diagnostics", DiagnosticArray, NEWS).status:
            values = {pair.key: pair.value for pair in report.values}
            if report.name == "jetbot_controller: motors" and "bus" in values:
                return values["board"], values["bus"]
    raise rospy.ROSException("the controller does not tell on /diagnostics which bus it is on")


def status():
    """What the controller says it does."""
    return rospy.wait_for_message("/jetbot_controller/status", String, NEWS).data


def not_obeyed(how):
    """The sentence about wheels that do not obey; how: what they do."""
    return f"The wheels do not obey: {how}{reason()}"


def reason():
    """The end of a sentence: what the controller says it does."""
    said = status()
    release = "; release that with rostopic pub -1 /emergency_stop std_msgs/Bool false"
    return f", and the controller says {said!r}{release if 'emergency' in said else ''}"


def told(speeds):
    """Speeds in words."""
    return " and ".join(f"{speed:.2f}" for speed in speeds)
