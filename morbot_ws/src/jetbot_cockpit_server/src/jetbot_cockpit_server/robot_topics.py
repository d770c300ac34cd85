"""One robot, by its topics: what its controller and its simulator publish, decoded only as often as it is shown."""

import threading
import time
from typing import Optional

import genpy
import rospy
from diagnostic_msgs.msg import DiagnosticStatus
from nav_msgs.msg import Odometry
from std_msgs.msg import Float32MultiArray, String
from std_srvs.srv import Empty

from jetbot.text import printable
from jetbot_ros.colors import color_of
from jetbot_ros.holds import EMERGENCY_STOP, OWN_EMERGENCY_STOP, Hold

from .emergency import EmergencySwitch
from .frames import Frames, yaw_of
from .task_topics import TaskTopics
from .view import Robot, geometry, label, program, rounded

CONTROLLER = "/jetbot_controller"
SIMULATOR_RESET = "/jetbot_simulator/reset"
ANSWER_TIMEOUT = 3.0  # s; a controller publishes diagnostics every second
MOTION_TIMEOUT = 2.0  # s after which a speed that nobody repeats is not shown
MAX_STATUS = 300      # characters


class RobotTopics:
    """Subscribes to a robot's topics; ``snapshot`` returns what they say. name: the robot's namespace."""

    def __init__(self, name: str, frames: Frames):
        self.name, self.simulated = name, False
        self._base, self._frames = name.rstrip("/"), frames
        self._color = "#" + "".join(f"{round(255 * part):02x}" for part in color_of(name.rpartition("/")[2]))
        self._active_at, self._status, self._level, self._geometry = time.monotonic(), "", 0, None
        self._repeats = False  # whether it publishes something every second; an unknown controller may not
        self._program = ""
        self._wheels = None, None  # command, duties
        self._odom = None  # (the newest message, still encoded, when it arrived in s)
        self._motion = (None, None, None)  # the decoded message, pose, speed
        self._resetting: Optional[threading.Thread] = None
        self._task_topics = TaskTopics(self._base, frames)
        self.stop = EmergencySwitch(f"{self._base}{CONTROLLER}/emergency_stop")
        self._status_subscriber = rospy.Subscriber(f"{self._base}{CONTROLLER}/status", String, self._on_status)
        self._subscribers = [
            self._status_subscriber,
            rospy.Subscriber(f"{self._base}{CONTROLLER}/wheels", Float32MultiArray, self._on_wheels, queue_size=1),
            rospy.Subscriber(f"{self._base}/odom", rospy.AnyMsg, self._on_odom, queue_size=1)]

    def close(self) -> None:
        """End all subscriptions."""
        self.stop.close()
        self._task_topics.close()
        for subscriber in self._subscribers:
            subscriber.unregister()

    @property
    def connected(self) -> bool:
        """Whether its controller's process lives, as far as the connection shows."""
        return self._status_subscriber.get_num_connections() > 0

    @property
    def in_emergency_stop(self) -> bool:
        """Whether its controller says that the emergency stop of all robots holds it."""
        return self._is_held_by(EMERGENCY_STOP)

    def diagnose(self, status: DiagnosticStatus) -> None:
        """Take what the controller publishes on /diagnostics."""
        self._active_at, self._repeats, self._level = time.monotonic(), True, status.level
        values = {item.key: item.value for item in status.values}
        self._geometry = geometry(values.get("wheel_separation"), values.get("max_speed"))
        self._program = program(values.get("commanded by"), rospy.get_name())

    def snapshot(self, now: float, master: bool) -> Robot:
        """Return what is known of the robot now. master: whether the ROS master answers; else diagnostics are late."""
        ended = self._status and not self.connected
        silent = now - self._active_at > ANSWER_TIMEOUT and (self._repeats or not self._status)
        answers = not (ended or master and silent)
        pose, speed = self._pose_and_speed(now)
        command, wheels = self._wheels if answers else (None, None)
        return Robot(
            self.name, self._color, self._geometry, self.simulated,
            self._status if answers else f"{label(self.name)} does not answer. Restart it, or resume it with fg.",
            self._level > 0, answers, self.stop.engaged or self._is_held_by(OWN_EMERGENCY_STOP), pose, speed, command,
            wheels, self._program, *self._task_topics.snapshot(now))

    def forget_result(self) -> None:
        """It was put back to its start: the score of its last drive is no longer shown."""
        self._task_topics.forget_result()

    def reset(self) -> bool:
        """Put the simulated robot back to its start, in a thread; return False while the last time still hangs."""
        if self._resetting and self._resetting.is_alive():
            return False
        self._resetting = threading.Thread(target=self._call_reset, daemon=True)
        self._resetting.start()
        return True

    def _is_held_by(self, hold: Hold):
        return self._status.startswith(f"stopped: {hold.reason}")

    def _call_reset(self):
        try:
            rospy.ServiceProxy(self._base + SIMULATOR_RESET, Empty)()
        except (rospy.ServiceException, rospy.ROSException, OSError) as error:
            rospy.logwarn(f"{label(self.name)} was not put back: {printable(error)}")

    def _on_status(self, message):
        self._active_at, self._status = time.monotonic(), printable(message.data)[:MAX_STATUS]

    def _on_wheels(self, message):
        self._active_at, self._repeats = time.monotonic(), True
        if len(message.data) == 4:  # x, z, left, right
            self._wheels = rounded(message.data[:2]), rounded(message.data[2:])

    def _on_odom(self, message):
        self._odom = message, time.monotonic()

    def _pose_and_speed(self, now):
        if not self._odom:
            return None, None
        message, at = self._odom
        if self._motion[0] is not message:
            self._motion = (message, *self._decode(message))
        _, pose, speed = self._motion
        return pose, None if speed and any(speed) and now - at > MOTION_TIMEOUT else speed

    def _decode(self, message):
        try:
            odom = Odometry().deserialize(message._buff)
        except (genpy.DeserializationError, ValueError):  # the topic is another program's, of another type
            return None, None
        position, twist = odom.pose.pose.position, odom.twist.twist
        pose = self._frames.on_map(odom.header.frame_id, (position.x, position.y, yaw_of(odom.pose.pose.orientation)))
        return rounded(pose), rounded((twist.linear.x, twist.angular.z))
