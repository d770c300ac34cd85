"""The parameters of the camera."""

from jetbot.camera.sources import NUMBERS
from jetbot.kinds import BOOLEAN, Kind
from jetbot_ros.node_parameters import Parameter

TEXT = Kind(lambda value: isinstance(value, str), "text")  # jetbot.camera.sources knows what it may be

PARAMETERS = {
    "source": Parameter("", TEXT, "csi, usb, /dev/videoN, fake, file:FOLDER or command:COMMAND"),
    "width": Parameter(224, NUMBERS["width"], "width of the pictures", "pixels"),
    "height": Parameter(224, NUMBERS["height"], "height of the pictures", "pixels"),
    "fps": Parameter(20, NUMBERS["fps"], "pictures per second", "Hz"),
    "quality": Parameter(75, NUMBERS["quality"], "quality of the JPEGs, 1 to 95"),
    "flip": Parameter(False, BOOLEAN, "true: the camera is mounted upside down"),
}
