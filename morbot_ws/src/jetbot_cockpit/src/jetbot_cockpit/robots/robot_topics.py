"""One robot, by its topics: what its controller and its simulator publish, and its emergency stop."""

import contextlib
import math
import threading
import time
from typing import Callable, Dict, Optional

import rospy
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from nav_msgs.msg import Odometry
from sensor_msgs.msg import BatteryState
from std_msgs.msg import Bool, Float32MultiArray
from std_srvs.srv import Empty

from jetbot.kinematics import Pose
from jetbot.sentence import Sentence
from jetbot.text import printable
from jetbot_ros import contract
from jetbot_ros.announcer import Announcer
from jetbot_ros.colors import web_color_of
from jetbot_ros.links import Graph
from jetbot_ros.state import OWN_EMERGENCY_STOP, UNKNOWN, read

from ..session.snapshot import RobotSnapshot, label
from .map_topics import Drawing, Frames
from .recording import Readings, Recording
from .reports import TaskTracker, decode_task, geometry, health, program, rounded, yaw_of

ANSWER_TIMEOUT = 3.0  # s; a controller publishes diagnostics every second
MOTION_TIMEOUT = 2.0  # s after which a speed that nobody repeats is not shown
ATTENTION = 5.0       # s for which line and battery are followed after a page has asked for them
BACKLOG = 10          # messages that are read at once after a pause of this process: curves show them all
IN_FLIGHT = 0.3       # s that a message of another program may take


class StopTopic:
    """An emergency stop, of all robots or of one: a latched topic, which others publish too.

    engaged: its value; by_others: whether another program has engaged it, perhaps as well; latched: whether it is
    published here, and so stops a robot that comes back.
    It is sent in the thread that sets it: rospy's queue lets every other thread run between two robots. graph: returns
    who listens (links.Links.graph), to tell those who are not connected, as the master may be unable to.
    """

    def __init__(self, topic: str, graph: Callable[[], Graph]):
        self.engaged = self.by_others = False
        self.latched, self._set_at = False, -math.inf
        self._lock = threading.Lock()  # a stop and another program's release: one after the other
        self._publisher = rospy.Publisher(topic, Bool, queue_size=None, latch=True)
        self._announcer, self._graph = Announcer(self._publisher), graph
        self._subscriber = rospy.Subscriber(topic, Bool, self._on_message)

    def set(self, engaged: bool) -> None:
        """Publish it; robots that start later obey it too."""
        with self._lock:
            self._set(engaged)

    def _set(self, engaged):
        self.engaged = self.latched = engaged
        self.by_others = self.by_others and engaged
        self._set_at = time.monotonic()
        self._publish()

    def _publish(self):
        with contextlib.suppress(rospy.ROSException, AttributeError):  # closed: the robot has ended, or this node
            self._publisher.publish(self.latched)
            self._announcer.announce(self._graph())

    def close(self) -> None:
        """End the publisher and the subscriber."""
        self._publisher.unregister()
        self._subscriber.unregister()

    def _on_message(self, message):
        if message._connection_header.get("callerid") == rospy.get_name():
            return
        with self._lock:
            undone = self.latched and not message.data
            if undone and time.monotonic() - self._set_at < IN_FLIGHT:
                self._publish()  # a release that was sent before the stop
                return
            self.engaged = self.by_others = message.data
            if undone:  # else a robot that starts later would be stopped by a stop that is over
                self._set(False)


class RobotTopics:
    """Subscribes to a robot's topics; ``snapshot`` returns what they say.

    name: the robot's namespace; graph: as of StopTopic.
    """

    def __init__(self, name: str, frames: Frames, graph: Callable[[], Graph]):
        self.name, self.simulated = name, False
        self._base, self._frames = name.rstrip("/"), frames
        self._color = web_color_of(name.rpartition("/")[2])
        self._active_at, self._state, self._level, self._geometry = time.monotonic(), UNKNOWN, 0, None
        self._repeats = False  # whether it publishes something every second; an unknown controller may not
        self._program, self._health = "", None
        self._wheels = None, None  # command, duties
        self._odom, self._moved_at = None, 0.0
        self._asked_at, self._drawn_at, self._line, self._recording = -math.inf, -math.inf, None, Recording()
        self._resetting: Optional[threading.Thread] = None
        self._tracker = TaskTracker()
        self._drawings = [Drawing(f"{self._base}/{topic}", frames) for topic in (contract.WORLD, contract.TASK_COURSE)]
        self._reported = "", None  # who drives, and what has interrupted that
        self._driver = rospy.Publisher(f"{self._base}/{contract.DRIVER}", DiagnosticStatus, queue_size=10, latch=True)
        self.emergency_stop = StopTopic(f"{self._base}/{contract.OWN_STOP}", graph)
        self._state_subscriber = rospy.Subscriber(f"{self._base}/{contract.STATE}", DiagnosticStatus, self._on_state)
        self._task_subscriber = rospy.Subscriber(f"{self._base}/{contract.TASK}", DiagnosticStatus, self._on_task,
                                                 queue_size=1)
        self._subscribers = [
            self._state_subscriber, self._task_subscriber, *(drawing.subscriber for drawing in self._drawings),
            rospy.Subscriber(f"{self._base}/{contract.WHEELS}", Float32MultiArray, self._on_wheels,
                             queue_size=BACKLOG),
            rospy.Subscriber(f"{self._base}/odom", Odometry, self._on_odom, queue_size=BACKLOG)]
        self._asked: Dict[str, rospy.Subscriber] = {}  # by topic

    def close(self) -> None:
        """End all topics."""
        self.emergency_stop.close()
        self._driver.unregister()
        for subscriber in filter(None, [*self._subscribers, *self._asked.values()]):
            subscriber.unregister()

    @property
    def connected(self) -> bool:
        """Whether its controller's process lives, as far as the connection shows."""
        return self._state_subscriber.get_num_connections() > 0

    def is_held_by(self, hold: str) -> bool:
        """Return whether its controller says that this keeps it stopped."""
        return hold in self._state.holds

    def diagnose(self, status: DiagnosticStatus) -> None:
        """Take what the controller publishes on /diagnostics."""
        self._active_at, self._repeats, self._level = time.monotonic(), True, status.level
        values = {item.key: item.value for item in status.values}
        self._geometry = geometry(values.get("wheel_separation"), values.get("max_speed"))
        self._program = program(values.get("commanded by"), rospy.get_name())

    def diagnose_health(self, status: DiagnosticStatus) -> None:
        """Take the readings that the controller publishes on /diagnostics."""
        self._health = health({item.key: item.value for item in status.values})

    def snapshot(self, now: float, master: bool) -> RobotSnapshot:
        """Return what is known of the robot now. master: whether the ROS master answers; else diagnostics are late."""
        ended = self._state is not UNKNOWN and not self.connected
        silent = now - self._active_at > ANSWER_TIMEOUT and (self._repeats or self._state is UNKNOWN)
        answers = not (ended or master and silent)
        state = self._state if answers else UNKNOWN._replace(
            sentence=f"{label(self.name)} does not answer. Restart it, or resume it with fg.")
        stopped = self.emergency_stop.engaged or self.is_held_by(OWN_EMERGENCY_STOP)
        pose, speed = self._pose_and_speed(now)
        command, wheels = self._wheels if answers else (None, None)
        shapes = tuple(shape for drawing in self._drawings for shape in drawing.shapes())
        task = self._tracker.current(self._task_subscriber.get_num_connections() > 0, now)
        return RobotSnapshot(
            self.name, color=self._color, geometry=self._geometry, simulated=self.simulated, state=state,
            warning=self._level > 0, answers=answers, stopped=stopped, pose=pose, speed=speed, command=command,
            wheels=wheels, program=self._program, shapes=shapes, task=task,
            health=self._health if answers else None,
            judged_elsewhere=any(name.rpartition("/")[2] != contract.CLASS_JUDGE for name in self._judges()))

    def senses(self, now: float) -> dict:
        """Return what a program reads of the robot, as fields of the message "program"; None: not known."""
        self._asked_at = now
        (pose, speed), (command, wheels) = self._pose_and_speed(now), self._wheels
        return {"pose": pose, "speed": speed, "line": self._line, "command": command, "wheels": wheels}

    def readings(self, since: Optional[int], eyes: bool) -> Readings:
        """Return what it has reported after the row with this number, None: no row yet. eyes: follow the line, too."""
        self._drawn_at = time.monotonic()
        if eyes:
            self._asked_at = self._drawn_at
        return self._recording.since(since)

    def follow_asked(self) -> None:
        """Subscribe to line sensor and battery while pages ask: a line costs a message per 20 ms. It may block."""
        now = time.monotonic()
        for topic, kind, callback, asked_at in (("line", Float32MultiArray, self._on_line, self._asked_at),
                                                ("battery", BatteryState, self._on_battery, self._drawn_at)):
            asked = now - asked_at < ATTENTION
            if asked and topic not in self._asked:
                self._asked[topic] = rospy.Subscriber(f"{self._base}/{topic}", kind, callback, queue_size=BACKLOG)
            elif not asked and topic in self._asked:
                self._asked.pop(topic).unregister()
        if "line" not in self._asked:
            self._line = None

    def report_driver(self, name: str, interruption: Optional[Sentence]) -> None:
        """Publish what ``driver`` holds, if it has changed."""
        if (name, interruption) != self._reported:
            self._reported = name, interruption
            with contextlib.suppress(rospy.ROSException):  # closed: the robot has ended meanwhile, or this node
                values = {"name": name, **({"interruption": interruption.code, **interruption.arguments}
                                           if interruption else {})}
                self._driver.publish(DiagnosticStatus(name="driver", message=str(interruption or ""),
                                                      values=[KeyValue(*pair) for pair in values.items()]))

    def reset(self) -> bool:
        """Put the simulated robot back to its start, in a thread; return False while the last time still hangs."""
        if self._resetting and self._resetting.is_alive():
            return False
        self._resetting = threading.Thread(target=self._call_reset, daemon=True)
        self._resetting.start()
        return True

    def _call_reset(self):
        try:
            rospy.ServiceProxy(f"{self._base}/{contract.RESET}", Empty)()
        except (rospy.ServiceException, rospy.ROSException, OSError) as error:
            rospy.logwarn(f"{label(self.name)} was not put back: {printable(error)}")

    def _on_state(self, message):
        self._active_at, self._state = time.monotonic(), read(message)

    def _on_wheels(self, message):
        self._active_at, self._repeats = time.monotonic(), True
        if len(message.data) == 4:  # contract.WHEELS_LABEL
            self._wheels = rounded(message.data[:2]), rounded(message.data[2:])
            self._recording.add("wheels", rospy.get_time(), *message.data)

    def _on_line(self, message):
        self._line = rounded(message.data) if len(message.data) == 3 else None
        if self._line:
            self._recording.add("line", rospy.get_time(), *message.data)

    def _on_battery(self, message):
        self._recording.add("battery", message.header.stamp.to_sec(), message.voltage)

    def _on_odom(self, message):
        self._odom, self._moved_at = message, time.monotonic()
        pose, twist = message.pose.pose, message.twist.twist
        self._recording.add("odom", message.header.stamp.to_sec(), pose.position.x, pose.position.y,
                            yaw_of(pose.orientation), twist.linear.x, twist.angular.z)

    def _on_task(self, message):
        values = {item.key: item.value for item in message.values}
        self._tracker.update(decode_task(message.name, message.message, values), time.monotonic())

    def _judges(self):
        """Return the nodes that publish how it does at a task."""
        return [connection.callerid_pub for connection in self._task_subscriber.impl.connections]

    def _pose_and_speed(self, now):
        odom = self._odom
        if not odom:
            return None, None
        position, twist = odom.pose.pose.position, odom.twist.twist
        pose = Pose(position.x, position.y, yaw_of(odom.pose.pose.orientation))
        speed = rounded((twist.linear.x, twist.angular.z))
        shown = speed if speed and (not any(speed) or now - self._moved_at <= MOTION_TIMEOUT) else None
        return rounded(self._frames.on_map(odom.header.frame_id, pose)), shown
