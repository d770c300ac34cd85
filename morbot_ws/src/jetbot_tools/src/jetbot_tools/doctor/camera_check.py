"""Checks of the camera: which there is, who uses it, and whether a picture comes. A robot drives without one."""

import os
import shlex
import time
from pathlib import Path
from typing import Iterator, List

from jetbot import host
from jetbot.camera.sources import find_command
from jetbot.camera.stream import Stream
from jetbot.errors import JetbotError

from .computer import Check

VIDEO = Path("/sys/class/video4linux")
CAMERAS = ("csi", "usb")  # sources that may be any device
BETWEEN = "nvargus-daemon"  # a Jetson's, between its camera and every program
NONE = Check("camera", True, "none found")


def check_cameras() -> Iterator[Check]:
    """Yield a check of what JETBOT_CAMERA names; without, of what this computer has: on a ribbon cable, and on USB."""
    named = os.environ.get("JETBOT_CAMERA")
    on_usb = [f"/dev/{video.name}" for video in sorted(VIDEO.glob("video*")) if is_on_usb(video)]
    on_cable = ["csi"] if host.robot_bus(host.model()) is not None else []
    sources = [named] if named else on_cable + on_usb
    yield from (check_camera(source, bool(named)) for source in sources)
    if not sources:
        yield NONE


def is_on_usb(video: Path) -> bool:
    """Return whether a folder of VIDEO is a USB camera's; its second one has no pictures, but their times and the like.
    """
    try:
        return (video / "device/driver").resolve().name == "uvcvideo" and (video / "index").read_text().strip() == "0"
    except OSError:  # unplugged meanwhile
        return False


def check_camera(source: str, named: bool) -> Check:
    """Check whether a picture comes, unless another program uses the camera; no camera is a fault if it is named."""
    name, users = f"camera {source}", users_of(source)
    if users:
        return Check(name, True, f"in use by {', '.join(users)}")
    begin = time.monotonic()
    try:
        require_picture(source)
    except JetbotError as error:
        return Check(name, not named and error.reason == "there is no such camera", error.reason, error.advice)
    return Check(name, True, f"its first picture came after {time.monotonic() - begin:.1f} s",
                 f"Start it with the robot: camera:=true camera_source:={shlex.quote(source)}")


def require_picture(source: str) -> None:
    """Wait for a picture; raise JetbotError if none comes."""
    stream = Stream(find_command(source), report=lambda _: None)
    stream.start()
    try:
        stream.require_picture()
    finally:
        stream.stop()


def users_of(source: str, proc: Path = Path("/proc")) -> List[str]:
    """Return the programs that use a camera, as far as this user may see."""
    devices = [source] if source.startswith("/dev/") else Path("/dev").glob("video*") if source in CAMERAS else ()
    pids = host.processes_with(set(map(os.path.realpath, devices)), proc)
    names = {pid: host.program_name(pid, proc) for pid in pids}
    return [f"{name} ({pid})" for pid, name in names.items() if name != BETWEEN]
