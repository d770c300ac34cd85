"""Where pictures come from: a source is a command that writes JPEGs to its standard output, a row of SOURCES."""

import os
import re
import shlex
import shutil
import sys
from pathlib import Path
from typing import NamedTuple, Tuple

from ..errors import InvalidValue, JetbotError
from ..kinds import whole

PLAY = f"exec {shlex.quote(sys.executable)} {shlex.quote(str(Path(__file__).with_name('play.py')))}"
RPICAM = ("exec {program} --codec mjpeg --mode 1640:1232 --width {width} --height {height} --framerate {fps}"
          " --quality {quality} --timeout 0 --nopreview --flush{flip} --output -")
TO_STDOUT = "jpegenc quality={quality} ! fdsink fd=3 3>&1 >&2"  # GStreamer and its plugins print to stdout
FROM_CSI = ("exec {program} -q nvarguscamerasrc sensor-mode=3 ! 'video/x-raw(memory:NVMM),width=816,height=616,"
            "format=NV12,framerate={fps}/1' ! nvvidconv{flip} ! "
            "video/x-raw,width={width},height={height},format=I420 ! ")
FROM_USB = ("exec {program} -q v4l2src device={name} ! decodebin ! videoconvert ! videoscale ! videorate{flip} ! "
            "video/x-raw,width={width},height={height},format=I420,framerate={fps}/1 ! ")
CHECK_CABLE = "Check the ribbon cable of the camera."
RESTART_DAEMON = "Try: sudo systemctl restart nvargus-daemon"
NUMBERS = {"width": whole(4096), "height": whole(4096), "fps": whole(120), "quality": whole(95)}
REPLUG = "Unplug the camera, plug it in again, and try another port."
NO_CAMERA = "Is it connected? Without a camera, type first: export JETBOT_CAMERA=fake"
TROUBLES = (  # what a command prints: a pattern, the reason, the advice
    (r"no element \"nv", "GStreamer has not what a Jetson's CSI camera needs",
     "Choose another: export JETBOT_CAMERA=usb   In a container, the Jetson needs: nvidia-container-toolkit"),
    (r"no element \"(\w+)\"", r"GStreamer has no element \1",
     "Install: sudo apt install gstreamer1.0-plugins-base gstreamer1.0-plugins-good"),
    (r"(?i)(?:is|resource) busy|failed to acquire camera|in use", "another program uses the camera",
     "End that program, or shut down the other notebook's kernel."),
    (r"(?i)permission denied", "this user may not use the camera",
     "Join its group: sudo usermod -aG video $USER   and log in again."),
    (r"(?i)no cameras? available|cannot identify device|no such device", "there is no such camera", NO_CAMERA),
    (r"(?i)argus|CaptureSession", "the camera's daemon does not answer", RESTART_DAEMON),
)


class Source(NamedTuple):
    """A source: the program that it needs, its shell command, what there turns the picture upside down, the program's
    Debian package, what to do when no picture comes, what it may print.

    {program}, {name}, {width}, {height}, {fps}, {quality} and {flip} in the command are replaced.
    """

    program: str
    command: str
    flip: str = ""
    package: str = ""
    when_hung: str = ""
    troubles: Tuple[Tuple[str, str, str], ...] = ()


SOURCES = {  # the first whose program is installed
    "csi": (Source("rpicam-vid", RPICAM, " --hflip --vflip", "rpicam-apps", CHECK_CABLE, TROUBLES),
            Source("libcamera-vid", RPICAM, " --hflip --vflip", "libcamera-apps", CHECK_CABLE, TROUBLES),
            Source("gst-launch-1.0", FROM_CSI + TO_STDOUT, " flip-method=2", "gstreamer1.0-tools", RESTART_DAEMON,
                   TROUBLES)),
    "usb": (Source("gst-launch-1.0", FROM_USB + TO_STDOUT, " ! videoflip method=rotate-180",
                   "gstreamer1.0-tools gstreamer1.0-plugins-base gstreamer1.0-plugins-good", REPLUG, TROUBLES),),
    "fake": (Source("sh", PLAY + " fake {width} {height} {fps} {quality}{flip}", " 180"),),
    "file": (Source("sh", PLAY + " {name} {width} {height} {fps} {quality}{flip}", " 180"),),
    "command": (Source("sh", "{command}", when_hung="Try the command by itself."),),
}


class Command(NamedTuple):
    """How to get the pictures of a source: a shell command, and its Source."""

    line: str
    source: Source

    def explain(self, printed: bytes, otherwise: str) -> JetbotError:
        """Return the error for a command that sends no pictures. printed: what it says; otherwise: why, if nothing."""
        text = printed.decode(errors="replace")
        for pattern, reason, advice in self.source.troubles:
            found = re.search(pattern, text)
            if found:
                return JetbotError(found.expand(reason), advice)
        last = next((line for line in reversed(text.splitlines()) if line.strip()), None)
        return JetbotError(f"the camera's program sends no pictures: {last}" if last else otherwise,
                           self.source.when_hung)


def find_command(source: str = "", width: int = 224, height: int = 224, fps: int = 30, quality: int = 75,
                 flip: bool = False) -> Command:
    """Return the command of a source, by default JETBOT_CAMERA, else csi.

    source: csi, usb, a device such as /dev/video0, fake, ``file:FOLDER``, or ``command:...``, a shell command of your
    own. quality: of the JPEGs, 1 to 95. flip: whether to turn the pictures upside down.
    Raise InvalidValue for another name, a number that is none of NUMBERS, and a command to flip; JetbotError if the
    program is not installed.
    """
    numbers = {"width": width, "height": height, "fps": fps, "quality": quality}
    for name, value in numbers.items():
        NUMBERS[name].check(f"the {name}", value)
    kind, rest = parse(source or os.environ.get("JETBOT_CAMERA") or "csi")
    row = next((row for row in SOURCES[kind] if shutil.which(row.program)), None)
    if row is None:
        missing = SOURCES[kind][-1]
        raise JetbotError(f"the program {missing.program} is missing", f"Install: sudo apt install {missing.package}")
    if flip and not row.flip:
        raise InvalidValue("the pictures of a command cannot be flipped", "Let the command itself turn them.")
    return Command(row.command.format(program=row.program, name=shlex.quote(rest or "/dev/video0"), command=rest,
                                      flip=row.flip if flip else "", **numbers), row)


def parse(name: str) -> Tuple[str, str]:
    """Return which SOURCES a name means, and its device, folder or command, or "". Raise InvalidValue."""
    kind, _, rest = ("usb", "", name) if name.startswith("/dev/") else name.partition(":")
    if kind not in SOURCES or bool(rest) != (kind in ("file", "command") or name.startswith("/dev/")):
        raise InvalidValue(f"a camera cannot be {name!r}",
                           "Give csi, usb, /dev/videoN, fake, file:FOLDER or command:COMMAND.")
    return kind, rest
