"""The simulator: reads what the board commands, advances the model, publishes and prints its state."""

import math
import time
from collections import deque
from typing import Callable, Collection, Optional

import rospy
from geometry_msgs.msg import Pose2D, PoseStamped
from nav_msgs.msg import Path
from std_srvs.srv import Empty, EmptyResponse

from .diff_drive import PWM_FREQUENCY, DiffDriveModel, Pair, Pose
from .stall import StallReport
from .topics import SharedTopics

RATE = 50           # Hz
PATH_STEP = 0.05    # metres between two poses of the path
PATH_LENGTH = 1000  # poses; the oldest are dropped


class Simulator:
    """Drives the model at the speeds that ``wheel_speeds`` returns; publishes ``path`` and the SharedTopics.

    pwm_frequency: returns that of the board in Hz, None where it is fixed; others: as for SharedTopics.
    ``~set_pose`` and ``~reset`` hand a pose to the loop, which alone changes the model.
    """

    def __init__(self, model: DiffDriveModel, wheel_speeds: Callable[[], Pair],
                 pwm_frequency: Callable[[], Optional[float]], others: Collection[str]):
        self._model = model
        self._wheel_speeds, self._pwm_frequency = wheel_speeds, pwm_frequency
        self._start = model.pose
        self._new_pose = deque(maxlen=1)
        self._stepped_at = time.monotonic()
        self._printed = ""
        self._prefix = f"{rospy.get_namespace().strip('/')} ".lstrip()
        self._stall_report = StallReport()
        self._poses = deque(maxlen=PATH_LENGTH)
        self._topics = SharedTopics(others, model.pose)
        self._path = rospy.Publisher("path", Path, queue_size=1, latch=True)
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
        """Step and publish, and print once per second, until the node is shut down."""
        rospy.Timer(rospy.Duration(1.0), self._print_state)
        rate = rospy.Rate(RATE, reset=True)
        while not rospy.is_shutdown():
            self._step()
            self._publish()
            rate.sleep()

    def _step(self):
        if self._new_pose:
            self._model.pose = self._new_pose.popleft()
            self._poses.clear()
        now = time.monotonic()
        frequency = self._pwm_frequency()
        self._model.step(self._wheel_speeds(), now - self._stepped_at, frequency or PWM_FREQUENCY)
        self._stepped_at = now
        stall = self._stall_report.update(self._model.stalled, frequency is None, now)
        if stall:
            rospy.logwarn(self._prefix + stall)

    def _publish(self):
        odom = self._topics.publish(self._model)
        odom.header.frame_id = "map"
        position, last = odom.pose.pose.position, self._poses[-1].pose.position if self._poses else None
        if last is None or math.hypot(position.x - last.x, position.y - last.y) >= PATH_STEP:
            self._poses.append(PoseStamped(odom.header, odom.pose.pose))
            self._path.publish(Path(odom.header, list(self._poses)))

    def _print_state(self, _):
        """Print pose and wheel speeds if they have changed, with two decimals and no -0.00."""
        pose, wheels = self._model.pose, (self._model.left.speed, self._model.right.speed)
        x, y, left, right = (f"{round(value, 2) + 0.0:.2f}" for value in (pose.x, pose.y, *wheels))
        state = (f"at x {x} m, y {y} m, heading {round(math.degrees(pose.yaw))} deg; "
                 f"left wheel {left} m/s, right wheel {right} m/s")
        if state != self._printed:
            self._printed = state
            print(self._prefix + state, flush=True)
