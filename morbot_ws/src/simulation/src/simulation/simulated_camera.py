"""Publishes what the simulated robots see, from a thread that never delays their motion, while somebody subscribes."""

import threading
import time
from typing import Any, NamedTuple, Sequence, Tuple

import rospy
from rosgraph.names import namespace, resolve_name
from sensor_msgs.msg import CameraInfo, CompressedImage
from std_msgs.msg import Header

from jetbot.camera.jpeg import bgr8_to_jpeg
from jetbot.text import printable
from jetbot_ros.colors import color_of
from jetbot_ros.ros_messages import camera_info

from .diff_drive import Pose
from .world import World

SIZE = 224          # pixels, of the width and of the height
INTERVAL = 1 / 15   # s from one picture of a robot to the next, or more
SHARE = 0.6         # of a core, that pictures take at most
RETRY_AFTER = 10.0  # s


class View(NamedTuple):
    """Where a robot is at a time, and the world around it."""

    stamp: rospy.Time
    pose: Pose
    world: World


class SimulatedCamera:
    """A robot's camera. node: its simulator's name, in its namespace; view: what it sees next, None for nothing."""

    def __init__(self, node: str):
        self.color = color_of(namespace(node).strip("/").rpartition("/")[2])
        self.view, self._info = None, camera_info(SIZE, SIZE, namespace(node))
        self._images, self._infos = (
            rospy.Publisher(resolve_name(f"camera/{topic}", node), kind, queue_size=1)
            for topic, kind in (("image_raw/compressed", CompressedImage), ("camera_info", CameraInfo)))

    @property
    def wanted(self) -> bool:
        """Whether somebody subscribes."""
        return bool(self._images.get_num_connections() or self._infos.get_num_connections())

    def publish(self, others: Sequence[Tuple[Pose, Any]]) -> None:
        """Publish a picture, with other robots (pose, colour) in it."""
        from .picture import render  # here: it needs numpy and PIL
        view = self.view
        header = Header(stamp=view.stamp, frame_id=self._info.header.frame_id)
        if self._images.get_num_connections():
            jpeg = bgr8_to_jpeg(render(view.world, view.pose, others, SIZE, SIZE))
            self._images.publish(CompressedImage(header, "jpeg", jpeg))
        self._info.header = header
        self._infos.publish(self._info)


def start(cameras: Sequence[SimulatedCamera]) -> None:
    """Publish what the cameras see, in each the other robots, from a thread until the node is shut down."""
    threading.Thread(target=run, args=[cameras], daemon=True).start()


def run(cameras: Sequence[SimulatedCamera]) -> None:
    """Do what ``start`` says, in this thread."""
    due = time.monotonic()
    while not rospy.is_shutdown():
        for camera in cameras:
            if camera.view and camera.wanted:
                begin = time.thread_time()
                publish(camera, [other for other in cameras if other is not camera and other.view])
                time.sleep((time.thread_time() - begin) * (1 / SHARE - 1))
        now = time.monotonic()
        due = max(due + INTERVAL, now)
        time.sleep(due - now)


def publish(camera: SimulatedCamera, others: Sequence[SimulatedCamera]) -> None:
    """Publish what one camera sees; if that fails, log why, and pause: the robots drive on."""
    try:
        camera.publish([(other.view.pose, other.color) for other in others])
    except Exception as error:
        if not rospy.is_shutdown():  # which closes the topics
            advice = " Install: sudo apt install python3-numpy python3-pil" * isinstance(error, ImportError)
            rospy.logwarn_throttle_identical(600, printable(f"The simulated cameras show nothing: {error}.{advice}"))
            time.sleep(RETRY_AFTER)
