"""What the robots' cameras see, while somebody looks."""

import threading
import time
from functools import partial
from typing import Dict, Optional, Set

import rospy
from sensor_msgs.msg import CompressedImage

from jetbot.camera.jpeg import SOI, extent

from ..session.feed import Picture

MAX_SIZE = 1_000_000  # bytes of a picture
BUFFER = 2 * MAX_SIZE  # rospy drops older pictures only if it reads them at once
FRESH = 2.0           # s after which a picture is not the newest any more: its camera has stopped


class Cameras:
    """The newest picture of each robot that is looked at. No method blocks: a thread of its own asks the master."""

    def __init__(self):
        self._wanted: Set[str] = set()  # replaced, never changed
        self._changed = threading.Event()
        self._pictures: Dict[str, Picture] = {}
        threading.Thread(target=self._run, daemon=True).start()

    def watch(self, robots: Set[str]) -> None:
        """These robots are looked at, and no others."""
        if robots != self._wanted:
            self._wanted = robots
            self._changed.set()

    def newest(self, robot: str, now: float) -> Optional[Picture]:
        """Return the robot's newest picture, or None if it has none. now: monotonic s."""
        picture = self._pictures.get(robot)
        return picture if picture and now - picture.came_at < FRESH else None

    def _run(self):
        subscribers = {}
        while self._changed.wait():
            self._changed.clear()
            wanted = self._wanted
            for robot in subscribers.keys() - wanted:
                subscribers.pop(robot).unregister()
                self._pictures.pop(robot, None)
            for robot in wanted - subscribers.keys():
                subscribers[robot] = rospy.Subscriber(
                    f"{robot.rstrip('/')}/camera/image_raw/compressed", CompressedImage,
                    partial(self._on_picture, robot), queue_size=1, buff_size=BUFFER, tcp_nodelay=True)

    def _on_picture(self, robot, message):
        jpeg = message.data
        if robot in self._wanted and len(jpeg) <= MAX_SIZE and jpeg.startswith(SOI) and extent(jpeg) > 0:
            self._pictures[robot] = Picture(jpeg, message.header.stamp.to_sec(), time.monotonic())
