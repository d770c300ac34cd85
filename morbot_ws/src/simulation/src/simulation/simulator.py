"""The simulator: reads what the board commands, advances the model, publishes and prints its state."""

import math
import time
from collections import deque
from typing import Collection

import rospy
from geometry_msgs.msg import Point, Pose2D, PoseStamped
from geometry_msgs.msg import Pose as RosPose
from nav_msgs.msg import Path
from std_msgs.msg import Header
from std_srvs.srv import Empty, EmptyResponse

from jetbot.fake.motors import Motors
from jetbot_ros.messages import quaternion

from .diff_drive import PWM_FREQUENCY, DiffDriveModel, Pose
from .stall import StallReport
from .topics import SharedTopics

RATE = 50               # Hz, of the steps, and of what is published while a wheel turns
STOPPED_INTERVAL = 0.1  # s between two messages while none does
PATH_STEP = 0.05        # metres between two poses of the path
PATH_LENGTH = 1000      # poses; the oldest are dropped


class Simulator:
    """Drives the model as the fake hardware's ``motors`` turn; publishes ``path`` and the SharedTopics.

    others: as for SharedTopics.
    ``~set_pose`` and ``~reset`` hand a pose to the loop, which alone changes the model.
    """

    def __init__(self, model: DiffDriveModel, motors: Motors, others: Collection[str]):
        self._model, self._motors = model, motors
        self._start = model.pose
        self._new_pose = deque(maxlen=1)
        self._stepped_at, self._published_at = time.monotonic(), -math.inf
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
        due = time.monotonic()
        while not rospy.is_shutdown():
            was_moving = self._model.moving
            self._step()
            if was_moving or self._model.moving or self._stepped_at - self._published_at > STOPPED_INTERVAL:
                self._publish()
            due = max(due + 1 / RATE, time.monotonic())
            time.sleep(max(0.0, due - time.monotonic()))  # rospy.Rate would take more than the step

    def _step(self):
        if self._new_pose:
            self._model.pose = self._new_pose.popleft()
            self._poses.clear()
        now = time.monotonic()
        frequency = self._motors.pwm_frequency()
        self._model.step(self._motors.speeds(), now - self._stepped_at, frequency or PWM_FREQUENCY)
        self._stepped_at = now
        stall = self._stall_report.update(self._model.stalled, frequency is None, now)
        if stall:
            rospy.logwarn(self._prefix + stall)

    def _publish(self):
        self._published_at = self._stepped_at
        stamp, pose = rospy.Time.now(), self._model.pose
        self._topics.publish(stamp, self._model)
        last = self._poses[-1].pose.position if self._poses else None
        if last is None or math.hypot(pose.x - last.x, pose.y - last.y) >= PATH_STEP:
            header = Header(stamp=stamp, frame_id="map")
            self._poses.append(PoseStamped(header, RosPose(Point(pose.x, pose.y, 0.0), quaternion(pose.yaw))))
            self._path.publish(Path(header, list(self._poses)))

    def _print_state(self, _):
        """Print pose and wheel speeds if they have changed, with two decimals and no -0.00."""
        pose, wheels = self._model.pose, (self._model.left.speed, self._model.right.speed)
        x, y, left, right = (f"{round(value, 2) + 0.0:.2f}" for value in (pose.x, pose.y, *wheels))
        state = (f"at x {x} m, y {y} m, heading {round(math.degrees(pose.yaw))} deg; "
                 f"left wheel {left} m/s, right wheel {right} m/s")
        if state != self._printed:
            self._printed = state
            print(self._prefix + state, flush=True)
