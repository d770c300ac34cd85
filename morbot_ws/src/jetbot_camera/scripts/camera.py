#!/usr/bin/env python3
"""ROS node: publishes what a robot's camera sees. It drives nothing, and what goes wrong here stops no robot."""

import jetbot_ros.boot

import contextlib
import threading
import time

import rospy
from diagnostic_msgs.msg import DiagnosticStatus
from diagnostic_updater import Updater
from sensor_msgs.msg import CameraInfo, CompressedImage
from std_msgs.msg import Header

from jetbot.camera.sources import find_command
from jetbot.camera.stream import Stream
from jetbot_camera.camera_parameters import PARAMETERS
from jetbot_ros import failures, lifecycle, links
from jetbot_ros.launcher import Launcher
from jetbot_ros.node_parameters import check_values, private_parameters
from jetbot_ros.ros_messages import camera_info

INTERVAL = 1.0          # s between two messages on /diagnostics
SHUTDOWN_TIMEOUT = 5.0  # s for the end of this node, more than the stream takes


class CameraNode:
    """Publishes each picture as it comes, the newest alone. Raise JetbotError if the source cannot be."""

    def __init__(self):
        lifecycle.init_node("jetbot_camera")
        self.parameters = check_values(private_parameters(rospy.get_name(), rospy.get_param("~", {}), PARAMETERS),
                                       PARAMETERS)
        self.stream = Stream(find_command(**self.parameters), rospy.logwarn)
        self.images = rospy.Publisher("camera/image_raw/compressed", CompressedImage, queue_size=1)
        self.infos = rospy.Publisher("camera/camera_info", CameraInfo, queue_size=1)
        self.info = camera_info(self.parameters["width"], self.parameters["height"])
        self.counted = 0, time.monotonic()
        self.updater = Updater()
        self.updater.setHardwareID(self.parameters["source"])
        self.updater.add("camera", self.diagnose)

    def run(self):
        """Publish until a signal, the end of rospy or of roslaunch."""
        ended, launcher = lifecycle.ending(), Launcher()
        failures.before_end.append(self.stream.abandon)
        self.stream.start()
        links.stay_linked()
        threading.Thread(target=failures.lasting(self.publish, ended.is_set), daemon=True).start()
        while not ended.wait(INTERVAL) and not launcher.ended:
            launcher.poll()
            self.updater.force_update()
        ended.set()
        self.end()
        return 0

    def end(self):
        """End the camera's program, and leave ROS; within SHUTDOWN_TIMEOUT."""
        lifecycle.leave_within(SHUTDOWN_TIMEOUT)
        self.stream.stop()
        rospy.signal_shutdown("the camera has ended")

    def publish(self):
        """Publish until the stream is stopped."""
        with contextlib.suppress(rospy.ROSException):  # the end of rospy closes the topics
            for jpeg in self.stream:
                self.info.header = Header(stamp=rospy.Time.now(), frame_id=self.info.header.frame_id)
                self.images.publish(CompressedImage(self.info.header, "jpeg", jpeg))
                self.infos.publish(self.info)
                time.sleep(0.5 / self.parameters["fps"])  # a command may write more: the newest wins

    def diagnose(self, result):
        """Fill in the status for /diagnostics."""
        count, error, now = self.stream.count, self.stream.error, time.monotonic()
        (counted, since), self.counted = self.counted, (count, now)
        rate = f"{(count - counted) / (now - since):.1f} pictures per second" if count else "no picture yet"
        result.summary(DiagnosticStatus.ERROR if error else DiagnosticStatus.OK, str(error or rate))
        for name, value in {**self.parameters, "pictures": count}.items():
            result.add(name, value)
        return result


if __name__ == "__main__":
    lifecycle.main(lambda: CameraNode().run())
