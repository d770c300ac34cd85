"""The simulator: advances a simulated robot in time, publishes it, and obeys ``~set_pose``, ``~reset``, ``~world``."""

import time
from threading import Lock
from typing import Collection

import rospy
from geometry_msgs.msg import Pose2D
from std_msgs.msg import String
from std_srvs.srv import Empty, EmptyResponse

from jetbot import InvalidValue
from jetbot.text import printable

from .diff_drive import Pose
from .simulated_robot import SimulatedRobot, StepClock
from .topics import SharedTopics, TrueTopics
from .world_files import MAX_PLACE, parse

CYCLE = 2           # steps between two looks at the motors, and between two messages while a wheel turns
STOPPED_CYCLE = 10  # steps between two messages while none does


class Simulator:
    """The node's loop around a robot. others: as for SharedTopics."""

    def __init__(self, robot: SimulatedRobot, others: Collection[str]):
        self._robot, self._lock = robot, Lock()
        self._clock, self._published_at = StepClock(time.monotonic_ns(), rospy.Time.now().to_nsec()), -STOPPED_CYCLE
        self._prefix, self._printed = f"{rospy.get_namespace().strip('/')} ".lstrip(), ""
        self._topics = SharedTopics(others, robot.model.pose), TrueTopics(robot.model.world)
        rospy.Subscriber("~set_pose", Pose2D, self._on_set_pose, queue_size=1)
        rospy.Subscriber("~world", String, self._on_world, queue_size=1)
        rospy.Service("~reset", Empty, self._on_reset)

    def _on_set_pose(self, pose):
        if all(abs(value) <= MAX_PLACE for value in (pose.x, pose.y, pose.theta)):  # of NaN, this is False
            self._place(Pose(pose.x, pose.y, pose.theta))
        else:
            rospy.logwarn(f"A pose must be finite, and within {MAX_PLACE} m. The robot stays where it is.")

    def _on_reset(self, _):
        self._place()
        return EmptyResponse()

    def _place(self, *pose):
        with self._lock:
            self._robot.place(*pose)
            self._topics[1].clear_path()

    def _on_world(self, message):
        try:
            world = parse(message.data, "the world that was sent") if message.data else None
        except InvalidValue as error:
            rospy.logwarn(f"{printable(error)} It stays as it is.")
            return
        with self._lock:
            self._robot.enter(world)
            self._topics[1].draw(self._robot.model.world)

    def spin(self) -> None:
        """Step and publish, and print once per second, until the node is shut down."""
        rospy.Timer(rospy.Duration(1.0), self._print_state)
        while not rospy.is_shutdown():
            with self._lock:
                was_moving = self._robot.model.moving
                self._step()
                if was_moving or self._robot.model.moving or self._clock.steps - self._published_at >= STOPPED_CYCLE:
                    self._publish()
            time.sleep(self._clock.remaining(time.monotonic_ns(), CYCLE))  # rospy.Rate would take more than the step

    def _step(self):
        """Advance the robot by the steps that are due."""
        for sentence in self._robot.step(self._clock.update(time.monotonic_ns(), rospy.Time.now().to_nsec())):
            rospy.logwarn(self._prefix + sentence)

    def _publish(self):
        self._published_at = self._clock.steps
        for topics in self._topics:
            topics.publish(rospy.Time(0, self._clock.stamp), self._robot.model)

    def _print_state(self, _):
        """Print the robot's state if it has changed."""
        if self._robot.state != self._printed:
            self._printed = self._robot.state
            print(self._prefix + self._printed, flush=True)
