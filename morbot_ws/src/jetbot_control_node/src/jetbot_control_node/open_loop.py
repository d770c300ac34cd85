"""Open-loop odometry: where a robot without encoders is, by what its wheels are given, as ROS messages."""

import contextlib
import threading
import time
from typing import Dict, Tuple

import rospy
from sensor_msgs.msg import JointState

from jetbot import Robot
from jetbot_ros import messages

from .dead_reckoning import DeadReckoning, Motion
from .odometry import OdometryPublisher

MOVING_INTERVAL = 1 / 30  # s between two messages while a wheel turns
STOPPED_INTERVAL = 1.0    # s, while none does


class OpenLoopOdometry:
    """Publishes ``odom``, ``joint_states`` and, if ``publish_tf``, tf from a thread of its own, and at the end.

    An observer of the Supervisor. parameters: as ``parameters.resolve`` returns them.
    """

    def __init__(self, robot: Robot, parameters: Dict[str, object]):
        self._reckoning = DeadReckoning(robot.left_motor, robot.right_motor,
                                        parameters["max_speed"], parameters["wheel_separation"])
        self._odometry = OdometryPublisher(parameters["publish_tf"])
        self._joint_states = rospy.Publisher("joint_states", JointState, queue_size=1)
        self._started = threading.Event()
        rospy.on_shutdown(self._publish)
        threading.Thread(target=self._run, daemon=True).start()

    def __call__(self, duties: Tuple[float, float], now: float) -> None:
        was_moving = self._reckoning.motion.moving
        self._reckoning(duties, now)
        if self._reckoning.motion.moving and not was_moving:
            self._started.set()

    def _run(self):
        with contextlib.suppress(rospy.ROSException):  # a shutdown closes the topics meanwhile
            due = time.monotonic()
            while not rospy.is_shutdown():
                self._started.clear()
                motion = self._publish()
                due = max(due + MOVING_INTERVAL, time.monotonic())
                time.sleep(max(0.0, due - time.monotonic()))
                if not motion.moving:
                    self._started.wait(STOPPED_INTERVAL - MOVING_INTERVAL)
                    due = time.monotonic()

    def _publish(self) -> Motion:
        """Publish the motion at this moment, and return it."""
        stamp, motion = rospy.Time.now(), self._reckoning.motion.advance(time.monotonic())
        self._odometry.publish(stamp, motion)
        self._joint_states.publish(messages.joint_states(stamp, *motion.joints))
        return motion
