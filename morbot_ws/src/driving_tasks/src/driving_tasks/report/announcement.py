"""The task for those who watch: its state on the topic ``task``, its course and goal on ``task_course``."""

from typing import Iterable

import rospy
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from geometry_msgs.msg import Point, Pose, Vector3
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker, MarkerArray

from jetbot import kinematics
from jetbot.kinematics import from_frame
from jetbot.sentence import Sentence, dump
from jetbot_ros import contract
from jetbot_ros.ros_messages import quaternion

from ..scoring.recorder import DONE, DRIVING
from ..scoring.score import NO_LOSS, Result
from ..scoring.sentences import say
from ..scoring.tasks import Task

READY, CANCELLED = "ready", "cancelled"  # states, beside DRIVING and DONE
HEIGHT = 0.0015                    # m: above the lines on the floor, below the robot's path
COURSE_WIDTH = Vector3(x=0.01)     # m
ARROW = Vector3(0.15, 0.03, 0.03)  # m: length, width, height
COLOR = ColorRGBA(0.1, 0.7, 0.2, 1.0)


class Announcement:
    """Publishes, latched, how a robot does at its task. namespace: the robot's, "" or "/red".

    request: a word of whoever asked for it, which each report repeats; "" for none.
    """

    def __init__(self, namespace: str, task: Task, request: str = ""):
        self._task, self._request = task, request
        self._state = rospy.Publisher(f"{namespace}/{contract.TASK}", DiagnosticStatus, queue_size=10, latch=True)
        self._course = rospy.Publisher(f"{namespace}/{contract.TASK_COURSE}", MarkerArray, queue_size=10, latch=True)

    def close(self) -> None:
        """Publish nothing more; what is still to be sent is lost."""
        self._state.unregister()
        self._course.unregister()

    def driving(self, seconds: float) -> None:
        """Publish that the robot has been driving for so long."""
        self.publish(DRIVING, say("driving", seconds=f"{seconds:.0f}"), seconds=f"{seconds:.1f}")

    def done(self, result: Result, driver: str) -> None:
        """Publish the robot's score. driver: the name of who drove, "" if it is not known."""
        sentence, lost = (result.loss.sentence, f"{result.loss.points:.1f}") if result.loss else (NO_LOSS, "")
        self._send(DONE, result.sentence, [sentence], lost=lost, seconds=f"{result.drive.seconds:.1f}",
                   score=f"{result.score:.1f}", driver=driver)

    def draw(self, start: kinematics.Pose) -> None:
        """Show the course and its goal from this start on the map."""
        course = self._task.course
        line = marker("course", Marker.LINE_STRIP, COURSE_WIDTH,
                      points=[Point(*from_frame(start, point), HEIGHT) for point in course.points])
        place, heading = from_frame(start, course.goal[:2]), start.yaw + course.goal.yaw
        goal = marker("goal", Marker.ARROW, ARROW, pose=Pose(Point(*place, 0.0), quaternion(heading)))
        shown = [line] * (len(line.points) > 1) + [goal] * bool(course.steps)
        self._course.publish([Marker(action=Marker.DELETEALL), *shown])

    def clear(self) -> None:
        """Show no course."""
        self._course.publish([Marker(action=Marker.DELETEALL)])

    def publish(self, state: str, *sentences: Sentence, **values: str) -> None:
        """Publish a state with sentences for people."""
        self._send(state, in_english(sentences), sentences, **values)

    def _send(self, state, message, sentences, **values):
        pairs = {"state": state, "title": self._task.title, "request": self._request,
                 "sentences": dump(sentences), **values}
        self._state.publish(DiagnosticStatus(level=DiagnosticStatus.OK, name=self._task.name, message=message,
                                             values=[KeyValue(*pair) for pair in pairs.items()]))


def in_english(sentences: Iterable[Sentence]) -> str:
    """Return sentences one after the other."""
    return " ".join(map(str, sentences))


def marker(namespace: str, kind: int, scale: Vector3, pose: Pose = None, points: list = ()) -> Marker:
    """Return a marker on the map, in the colour of a course."""
    return Marker(header=Header(frame_id="map"), ns=namespace, type=kind, scale=scale, color=COLOR,
                  pose=pose or Pose(orientation=quaternion(0.0)), points=points)
