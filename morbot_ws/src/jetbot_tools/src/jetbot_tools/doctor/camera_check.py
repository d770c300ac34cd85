"""Checks of the camera: which there is, who uses it, and whether a picture comes. A robot drives without one."""

import fcntl
import os
import shlex
import struct
import time
from pathlib import Path
from typing import Iterator, List, Tuple

from jetbot import host
from jetbot.camera.sources import find_command
from jetbot.camera.stream import Stream
from jetbot.errors import JetbotError

from .computer import Check

DEV = Path("/dev")
# videodev2.h: struct v4l2_capability is driver, card, bus_info, version, capabilities, device_caps, reserved.
VIDIOC_QUERYCAP, CAPABILITY = 0x80685600, struct.Struct("=16s32s32sIII12x")
V4L2_CAP_VIDEO_CAPTURE = 0x1
# The drivers of what a Raspberry Pi and a Jetson have between the camera on the ribbon cable and its program. Their
# devices deliver raw Bayer data, or only what that program sends them.
ON_CABLE = ("unicam", "bcm2835-isp", "rp1-cfe", "pispbe", "tegra-video")
CAMERAS = ("csi", "usb")  # sources that may be any device
BETWEEN = "nvargus-daemon"  # a Jetson's, between its camera and every program
NONE = Check("camera", True, "none found")


def check_cameras() -> Iterator[Check]:
    """Yield a check of what JETBOT_CAMERA names; without, of what this computer has: on a ribbon cable, and others."""
    named = os.environ.get("JETBOT_CAMERA")
    if named:
        yield check_camera(named, True)
        return
    checks = [check_camera("csi", False)] if host.robot_bus(host.model()) is not None else []
    videos = sorted(DEV.glob("video[0-9]*"), key=lambda video: (len(video.name), video.name))
    closed = [video for video in videos if not os.access(video, os.R_OK | os.W_OK)]
    cameras = filter(takes_pictures, videos)
    checks += [check_camera(f"/dev/{video.name}", False) for video in cameras]
    if closed:
        checks.append(Check("camera", False, f"this user may not open {closed[0]}",
                            host.permission_advice(closed[0], "video")))
    yield from checks or [NONE]


def takes_pictures(video: Path) -> bool:
    """Return whether a device delivers pictures by itself: not their times, as a USB camera's second one; no codec."""
    try:
        driver, capabilities = query(video)
    except OSError:  # unplugged meanwhile, or no device of Video4Linux
        return False
    return bool(capabilities & V4L2_CAP_VIDEO_CAPTURE) and driver not in ON_CABLE


def query(video: Path) -> Tuple[str, int]:
    """Return the driver of a device and the capabilities V4L2_CAP_... of it alone. Raise OSError."""
    with open(video, "rb", buffering=0) as device:
        answer = fcntl.ioctl(device, VIDIOC_QUERYCAP, bytes(CAPABILITY.size))
    driver, _, _, _, _, capabilities = CAPABILITY.unpack(answer)
    return driver.partition(b"\0")[0].decode(errors="replace"), capabilities


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
