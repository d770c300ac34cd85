"""Publishes the commands of the pads: one thread per driven robot, so that a robot that hangs delays no other."""

import contextlib
import math
import threading
import time
import warnings
from typing import Dict, Optional, Tuple

import rospy
from geometry_msgs.msg import Twist

from jetbot_ros.state import MANUAL_PRIORITY

from ..session.lease import Lease

SEND_TIMEOUT = 0.1      # s until a subscriber that reads nothing is disconnected
LINGER = 0.5            # s from the zero to the publisher's end: the master is asked nothing while all robots stop;
                        # and between two zeros while programs wait, less than MANUAL_PRIORITY
SHUTDOWN_TIMEOUT = 0.5  # s for the last zeros
ZERO = (0.0, 0.0)

Velocity = Tuple[float, float]  # m/s forward, rad/s to the left

# Without a queue, rospy sends in the thread that publishes: nothing is left unsent when the publisher ends.
warnings.filterwarnings("ignore", "The publisher should be created", SyntaxWarning)


class Drivers:
    """Drives robots, by their namespaces. Only ``close`` blocks. Needs an initialized node."""

    def __init__(self):
        self._drivers: Dict[str, Driver] = {}

    def drive(self, robot: str, velocity: Velocity, lease: Lease) -> None:
        """Drive the robot until its lease's dead man's switch fires."""
        self._driver(robot).drive(velocity, lease)

    def let_go(self, robot: str) -> None:
        """Publish one zero, and then nothing more."""
        if robot in self._drivers:
            self._drivers[robot].let_go()

    def hold(self, robot: str) -> bool:
        """Keep the robot's publisher while it stands; return whether a controller is connected to it."""
        return self._driver(robot).hold()

    def keep_waiting(self, robot: str, waiting: bool) -> None:
        """Let programs that command the robot wait until False, by zeros while nobody drives it."""
        self._driver(robot).keep_waiting(waiting)

    def resumes_in(self, robot: str, now: float) -> float:
        """Return the seconds until the commands of programs count, 0 or less if they do."""
        return self._driver(robot).sent_at + MANUAL_PRIORITY - now

    def _driver(self, robot):
        if robot not in self._drivers:
            self._drivers[robot] = Driver(robot)
        return self._drivers[robot]

    def close(self) -> None:
        """Let go of all robots; wait until they are sent their zeros, SHUTDOWN_TIMEOUT at most."""
        for driver in self._drivers.values():
            driver.let_go()
        deadline = time.monotonic() + SHUTDOWN_TIMEOUT
        for driver in self._drivers.values():
            driver.idle.wait(max(0.0, deadline - time.monotonic()))


class Driver(rospy.SubscribeListener):
    """Publishes what one robot is commanded, while it is driven, and one zero at the end.

    idle: set unless the robot is driven, or its last zero is still to be sent; sent_at: when the newest command was.
    """

    def __init__(self, robot: str):
        self._topic = f"{robot.rstrip('/')}/cmd_vel"
        self._velocity = ZERO  # unless the robot is driven
        self._lease: Optional[Lease] = None  # of the newest command
        self._pending = False  # something is to be sent
        self._waiting = False  # programs are to wait: zeros are repeated
        self._runs = False     # the thread
        self._connected = False  # a subscriber, to the publisher
        self.sent_at = -math.inf
        self._condition = threading.Condition()
        self.idle = threading.Event()
        self.idle.set()

    def drive(self, velocity: Velocity, lease: Lease) -> None:
        """Send this command, unless it is too old when its turn comes; then, or if no other follows, a zero."""
        with self._condition:
            self._lease = lease
            self._send(velocity)
            self.idle.clear()
            self._start()

    def hold(self) -> bool:
        """Send a zero unless the robot is driven, so that the publisher stays; return whether it is connected."""
        with self._condition:
            if self._velocity == ZERO:
                self._send(ZERO)
                self._start()
            return self._connected

    def keep_waiting(self, waiting: bool) -> None:
        """Repeat zeros while the robot is not driven (True), or end that."""
        with self._condition:
            self._waiting = waiting
            if waiting:
                self._send(self._velocity)
                self._start()

    def let_go(self) -> None:
        """Stop the robot."""
        with self._condition:
            self._send(ZERO)

    def peer_subscribe(self, *_) -> None:
        """A controller has connected: send it what was commanded before."""
        with self._condition:
            self._connected = True
            self._send(self._velocity)

    def _start(self):
        if not self._runs:
            self._runs = True
            threading.Thread(target=self._publish, name=self._topic, daemon=True).start()

    def _send(self, velocity):
        self._velocity, self._pending = velocity, True
        self._condition.notify()

    def _publish(self):
        """Publish until the robot is not driven any more; end the publisher."""
        publisher = rospy.Publisher(self._topic, Twist, self, tcp_nodelay=True, queue_size=None)
        try:
            for velocity in iter(self._next, None):
                limit_sending(publisher)
                message = Twist()
                message.linear.x, message.angular.z = velocity
                publisher.publish(message)
        except rospy.ROSException:
            pass  # a shutdown has closed the topic
        finally:
            publisher.unregister()

    def _next(self) -> Optional[Velocity]:
        """Wait for a command, or until the switch fires; return what the robot is to do, or None LINGER after zero."""
        with self._condition:
            if self._velocity == ZERO and not self._pending:
                self.idle.set()
            timeout = LINGER if self._velocity == ZERO else self._lease.remaining(time.monotonic())
            self._condition.wait_for(lambda: self._pending, timeout)
            if self._velocity != ZERO and self._lease.is_silent(time.monotonic()):
                self._send(ZERO)
            self._runs = self._pending or self._waiting or self._velocity != ZERO
            self._pending = False
            if not self._runs:
                self._connected = False
                return None
            self.sent_at = time.monotonic()
            return self._velocity


def limit_sending(publisher: rospy.Publisher) -> None:
    """Let a subscriber that hangs block the publisher for SEND_TIMEOUT once; rospy then closes its connection."""
    for connection in publisher.impl.connections:
        with contextlib.suppress(AttributeError, OSError):  # it is being closed
            connection.socket.settimeout(SEND_TIMEOUT)
