"""The simulator's loop: reads what the board commands, advances the model, publishes and reports its state."""

import itertools
import math
import time
from collections import deque
from typing import Callable

import rospy
from geometry_msgs.msg import Pose2D
from std_srvs.srv import Empty, EmptyResponse

from .diff_drive import DiffDriveModel, Pair
from .pose import Pose
from .publisher import StatePublisher

RATE = 50              # steps per second
STEPS_PER_REPORT = 50  # between two lines on the terminal


class Simulator:
    """Drives the model at the speeds that ``wheel_speeds`` returns.

    ``~set_pose`` and ``~reset`` hand a pose to the loop, which alone uses the model.
    """

    def __init__(self, model: DiffDriveModel, wheel_speeds: Callable[[], Pair], publisher: StatePublisher):
        self._model = model
        self._wheel_speeds = wheel_speeds
        self._publisher = publisher
        self._start = model.pose
        self._new_pose = deque(maxlen=1)
        self._stepped_at = time.monotonic()
        self._reported = None
        rospy.Subscriber("~set_pose", Pose2D, self._on_set_pose, queue_size=1)
        rospy.Service("~reset", Empty, self._on_reset)

    def _on_set_pose(self, pose):
        if all(map(math.isfinite, (pose.x, pose.y, pose.theta))):
            self._new_pose.append(Pose(pose.x, pose.y, pose.theta))
        else:
            rospy.logwarn("A pose must be finite. The robot stays where it is.")

    def _on_reset(self, _):
        self._new_pose.append(self._start)
        return EmptyResponse()

    def spin(self) -> None:
        """Step, publish and report until the node is shut down."""
        rate = rospy.Rate(RATE, reset=True)
        for step in itertools.count():
            if rospy.is_shutdown():
                return
            self._step()
            if step % STEPS_PER_REPORT == 0:
                self._report()
            rate.sleep()

    def _step(self):
        if self._new_pose:
            self._model.pose = self._new_pose.popleft()
            self._publisher.clear_path()
        now = time.monotonic()
        self._model.step(self._wheel_speeds(), now - self._stepped_at)
        self._stepped_at = now
        self._publisher.publish(self._model)

    def _report(self):
        state = format_state(self._model)
        if state != self._reported:
            self._reported = state
            print(f"{rospy.get_namespace().strip('/')} {state}".strip(), flush=True)


def format_state(model: DiffDriveModel) -> str:
    """Return pose and wheel speeds in one line, with two decimals and no -0.00."""
    x, y, left, right = (f"{round(value, 2) + 0.0:.2f}"
                         for value in (*model.pose[:2], model.left.speed, model.right.speed))
    return (f"at x {x} m, y {y} m, heading {round(math.degrees(model.pose.yaw))} deg; "
            f"left wheel {left} m/s, right wheel {right} m/s")
