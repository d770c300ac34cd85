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

from .collision import Collision
from .diff_drive import PWM_FREQUENCY, DiffDriveModel, Pose
from .stall import StallReport
from .step_clock import STEP, StepClock
from .topics import SharedTopics
from .world import World
from .world_topics import WorldTopics
from .worlds import MAX_PLACE

CYCLE = 2               # steps between two looks at the motors, and between two messages while a wheel turns
STOPPED_CYCLE = 10      # steps between two messages while none does
PATH_STEP = 0.05        # metres between two poses of the path
PATH_LENGTH = 1000      # poses; the oldest are dropped


class Simulator:
    """Drives the model as the fake hardware's ``motors`` turn; publishes ``path``, SharedTopics and WorldTopics.

    others: as for SharedTopics; world: as for WorldTopics.
    ``~set_pose`` and ``~reset`` hand a pose to the loop, which alone changes the model.
    """

    def __init__(self, model: DiffDriveModel, motors: Motors, others: Collection[str], world: World):
        self._model, self._motors = model, motors
        self._start = model.pose
        self._new_pose = deque(maxlen=1)
        self._clock, self._published_at = StepClock(time.monotonic_ns(), rospy.Time.now().to_nsec()), -STOPPED_CYCLE
        self._printed, self._touching = "", False
        self._prefix = f"{rospy.get_namespace().strip('/')} ".lstrip()
        self._stall_report = StallReport()
        self._poses = deque(maxlen=PATH_LENGTH)
        self._topics = SharedTopics(others, model.pose)
        self._world_topics = WorldTopics(world)
        self._path = rospy.Publisher("path", Path, queue_size=1, latch=True)
        rospy.Subscriber("~set_pose", Pose2D, self._on_set_pose, queue_size=1)
        rospy.Service("~reset", Empty, self._on_reset)

    def _on_set_pose(self, pose):
        if all(abs(value) <= MAX_PLACE for value in (pose.x, pose.y, pose.theta)):  # of NaN, this is False
            self._new_pose.append(Pose(pose.x, pose.y, pose.theta))
        else:
            rospy.logwarn(f"A pose must be finite, and within {MAX_PLACE} m. The robot stays where it is.")

    def _on_reset(self, _):
        self._new_pose.append(self._start)
        return EmptyResponse()

    def spin(self) -> None:
        """Step and publish, and print once per second, until the node is shut down."""
        rospy.Timer(rospy.Duration(1.0), self._print_state)
        while not rospy.is_shutdown():
            was_moving = self._model.moving
            self._place()
            self._step()
            if was_moving or self._model.moving or self._clock.steps - self._published_at >= STOPPED_CYCLE:
                self._publish()
            time.sleep(self._clock.remaining(time.monotonic_ns(), CYCLE))  # rospy.Rate would take more than the step

    def _place(self):
        """Take the pose and the world that were asked for."""
        if self._new_pose:
            self._model.pose = self._new_pose.popleft()
            self._poses.clear()
        world = self._world_topics.new_world()
        if world:
            self._model.collision = Collision(world) if world.walls else None

    def _step(self):
        """Advance the model by the steps that are due; log a stall or a contact once."""
        frequency, speeds = self._motors.pwm_frequency(), self._motors.speeds()
        for _ in range(self._clock.update(time.monotonic_ns(), rospy.Time.now().to_nsec())):
            self._model.step(speeds, STEP, frequency or PWM_FREQUENCY)
        stall = self._stall_report.update(self._model.stalled, frequency is None, self._clock.steps * STEP)
        if stall:
            rospy.logwarn(self._prefix + stall)
        was_touching, self._touching = self._touching, self._model.touching
        if self._touching and not was_touching:
            rospy.logwarn(f"{self._prefix}touched a wall")

    def _publish(self):
        self._published_at = self._clock.steps
        stamp, pose = rospy.Time(0, self._clock.stamp), self._model.pose
        self._topics.publish(stamp, self._model)
        self._world_topics.publish(stamp, self._model)
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
