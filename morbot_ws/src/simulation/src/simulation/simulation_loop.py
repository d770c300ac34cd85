"""The simulator: advances robots in time, publishes them, and obeys each one's ``set_pose``, ``reset``, ``world``."""

import time
from itertools import count
from threading import Lock
from typing import Collection, Sequence

import rospy
from geometry_msgs.msg import Pose2D
from rosgraph.names import namespace
from std_msgs.msg import String
from std_srvs.srv import Empty, EmptyResponse
from tf2_msgs.msg import TFMessage

from jetbot import InvalidValue
from jetbot.text import printable

from . import simulated_camera
from .diff_drive import Pose
from .simulated_camera import SimulatedCamera, View
from .simulated_robot import SimulatedRobot, StepClock
from .topics import Topics
from .world_files import MAX_PLACE, parse

CYCLE = 2           # steps between two looks at the motors, and between two messages while a wheel turns
STOPPED_CYCLES = 5  # between two messages while none does


class Simulator:
    """A robot with its topics and its service. node, others: as for Topics."""

    def __init__(self, node: str, robot: SimulatedRobot, others: Collection[str]):
        self._robot, self._lock = robot, Lock()
        self._prefix, self._printed = f"{namespace(node).strip('/')} ".lstrip(), ""
        with self._lock:  # until there are topics, which are the simulator's by this service: the judge looks at once
            rospy.Service(f"{node}/reset", Empty, self._on_reset)
            self._topics = Topics(node, others, robot.model)
        self.static_transform = self._topics.static_transform
        self.camera = SimulatedCamera(node)
        rospy.Subscriber(f"{node}/set_pose", Pose2D, self._on_set_pose, queue_size=1)
        rospy.Subscriber(f"{node}/world", String, self._on_world, queue_size=1)

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
            self._topics.clear_path()

    def _on_world(self, message):
        try:
            world = parse(message.data, "the world that was sent") if message.data else None
        except InvalidValue as error:
            rospy.logwarn(f"{printable(error)} It stays as it is.")
            return
        with self._lock:
            self._robot.enter(world)
            self._topics.draw(self._robot.model.world)

    def advance(self, steps: int, stamp: rospy.Time, always: bool) -> None:
        """Step, and publish if a wheel turns, or always. stamp: the time of the last step."""
        with self._lock:
            was_moving = self._robot.model.moving
            for sentence in self._robot.step(steps):
                rospy.logwarn(self._prefix + sentence)
            if was_moving or self._robot.model.moving or always:
                self._topics.publish(stamp, self._robot.model)
            self.camera.view = View(stamp, self._robot.model.pose, self._robot.model.world)

    def print_state(self) -> None:
        """Print the robot's state if it has changed."""
        if self._robot.state != self._printed:
            self._printed = self._robot.state
            print(self._prefix + self._printed, flush=True)


def spin(simulators: Sequence[Simulator]) -> None:
    """Step and publish all robots, and print once per second, until the node is shut down."""
    static_tf = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
    static_tf.publish([each.static_transform for each in simulators])  # in one: the last message alone is latched
    rospy.Timer(rospy.Duration(1.0), lambda _: [each.print_state() for each in simulators])
    simulated_camera.start([each.camera for each in simulators])
    clock = StepClock(now())
    for cycle in count():
        if rospy.is_shutdown():
            return
        steps = clock.update(now())
        for each in simulators:
            each.advance(steps, rospy.Time(0, clock.stamp), cycle % STOPPED_CYCLES == 0)
        time.sleep(clock.remaining(now(), CYCLE))  # rospy.Rate would take more than the step


def now() -> int:
    """Return the time in ns."""
    return rospy.Time.now().to_nsec()
