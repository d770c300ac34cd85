"""The parameters of the camera."""

from jetbot.kinds import BOOLEAN, Kind
from jetbot_ros.node_parameters import Parameter

MAX_SIZE = 4096  # pixels
MAX_FPS = 120


def whole(limit: int) -> Kind:
    """Return the kind of a whole number from 1 to this one."""
    return Kind(lambda value: type(value) is int and 1 <= value <= limit, f"a whole number from 1 to {limit}")


TEXT = Kind(lambda value: isinstance(value, str), "text")  # jetbot.camera.sources knows what it may be

PARAMETERS = {
    "source": Parameter("", TEXT, "csi, usb, /dev/videoN, fake, file:FOLDER or command:COMMAND"),
    "width": Parameter(224, whole(MAX_SIZE), "width of the pictures", "pixels"),
    "height": Parameter(224, whole(MAX_SIZE), "height of the pictures", "pixels"),
    "fps": Parameter(20, whole(MAX_FPS), "pictures per second", "Hz"),
    "quality": Parameter(75, whole(95), "quality of the JPEGs, 1 to 95"),
    "flip": Parameter(False, BOOLEAN, "true: the camera is mounted upside down"),
}
