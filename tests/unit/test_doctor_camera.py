"""What the doctor says of the camera: which there is, who uses it, whether a picture comes."""

import re
import struct
from functools import partial
from pathlib import Path

import pytest
from examined import lines, make_bare

from jetbot import host
from jetbot.camera import sources, stream
from jetbot_tools.doctor import camera_check

USB_CAMERA = 0x04200001  # V4L2_CAP_STREAMING, EXT_PIX_FORMAT, VIDEO_CAPTURE: what uvcvideo answers
PICTURE = r'printf "\377\330\377\332\000\002picture\377\331"; sleep 60'


@pytest.fixture(autouse=True)
def bare(monkeypatch, tmp_path):
    make_bare(monkeypatch, tmp_path)


@pytest.fixture
def plug_in(monkeypatch, tmp_path):
    """Return a function that plugs in a device of Video4Linux; its ioctl answers as a kernel does."""
    answers = {}
    (tmp_path / "dev").mkdir()

    def ioctl(device, request, _):
        assert request == 0x80685600  # VIDIOC_QUERYCAP
        if Path(device.name) not in answers:
            raise OSError(25, "Inappropriate ioctl for device")
        return answers[Path(device.name)]

    def plug(name, driver="uvcvideo", capabilities=USB_CAMERA, mode=0o660):
        device = tmp_path / "dev" / name
        device.touch(mode)
        every = capabilities | 0x80000000  # of all devices of the driver
        answers[device] = struct.pack("=16s32s32sIII12x", driver.encode(), b"a camera", b"bus",
                                                             0x60100, every, capabilities)
        return device

    monkeypatch.setattr(camera_check.fcntl, "ioctl", ioctl)
    return plug


@pytest.mark.parametrize("model, sources", [("", []), ("Raspberry Pi 5", ["csi"])])
def test_which_cameras_there_may_be(monkeypatch, plug_in, tmp_path, model, sources):
    cameras = [plug_in("video2"), plug_in("video7", "vivid"), plug_in("video10", "v4l2 loopback", 0x05200001)]
    plug_in("video3", "uvcvideo", 0x04A00000)     # a USB camera's times of its pictures
    plug_in("video8", "vivid", 0x05200002)        # takes pictures, gives none
    plug_in("video11", "bcm2835-codec", 0x04204000)
    plug_in("video14", "bcm2835-isp", 0x04200001)
    plug_in("video20", "unicam", 0x25200001)
    (tmp_path / "dev/video21").touch()            # not of Video4Linux
    monkeypatch.setattr(host, "model", lambda: model)
    monkeypatch.setattr(camera_check, "check_camera", lambda source, _: source)
    assert list(camera_check.check_cameras()) == sources + [f"/dev/{camera.name}" for camera in cameras]
    for camera in cameras:
        camera.unlink()
    assert sources or list(map(str, camera_check.check_cameras())) == ["ok  camera: none found."]
    monkeypatch.setenv("JETBOT_CAMERA", "fake")
    assert list(camera_check.check_cameras()) == ["fake"]


def test_a_device_that_this_user_may_not_open(monkeypatch, plug_in):
    def closed(*_):
        raise PermissionError

    monkeypatch.setattr(camera_check.os, "access", lambda path, mode: False)
    monkeypatch.setattr(camera_check, "query", closed)
    monkeypatch.setattr(host, "permission_advice", lambda device, group: f"Join {group}.")
    video = plug_in("video0")
    plug_in("video1")
    assert list(map(str, camera_check.check_cameras())) == [
        f"NOT camera: this user may not open {video}. Join video."]


@pytest.mark.parametrize("command, line", [
    (PICTURE, r"ok  camera SOURCE: its first picture came after \d\.\d s. Start it with the robot: camera:=true "
              "camera_source:='SOURCE'"),
    ("sleep 60", "NOT camera SOURCE: no picture came from the camera for 0.5 s. Try the command by itself.")])
def test_whether_a_picture_comes(monkeypatch, command, line):
    monkeypatch.setattr(stream, "START_TIMEOUT", 0.5)
    monkeypatch.setenv("JETBOT_CAMERA", f"command:{command}")
    assert re.fullmatch(line, lines()[-2].replace(f"command:{command}", "SOURCE"))


@pytest.mark.parametrize("printed, named, line", [
    ("Cannot identify device", "", "ok  camera /dev/video2: there is no such camera. Is it connected?"),
    ("Cannot identify device", "/dev/video7", "NOT camera /dev/video7: there is no such camera. Is it connected?"),
    ("Permission denied", "", "NOT camera /dev/video2: this user may not use the camera. Join its group:"),
    ("", "web", "NOT camera web: a camera cannot be 'web'. Give csi, usb,")])
def test_a_camera_that_is_not_there_is_a_fault_if_it_is_named(monkeypatch, plug_in, printed, named, line):
    plug_in("video2")
    monkeypatch.setenv("JETBOT_CAMERA", named)
    usb = sources.Source("sh", f"echo {printed} >&2", troubles=sources.TROUBLES)
    monkeypatch.setitem(sources.SOURCES, "usb", [usb])
    assert lines()[-2].startswith(line)


def test_who_uses_the_camera(monkeypatch, tmp_path):
    for pid, program in (7, "notebook"), (8, "nvargus-daemon"):
        (tmp_path / f"{pid}/fd").mkdir(parents=True)
        (tmp_path / f"{pid}/fd/3").symlink_to("/dev/video7")
        (tmp_path / f"{pid}/cmdline").write_text(f"/usr/bin/{program}\0")
    monkeypatch.setattr(camera_check, "users_of", partial(camera_check.users_of, proc=tmp_path))
    monkeypatch.setenv("JETBOT_CAMERA", "/dev/video7")
    assert lines()[-2] == "ok  camera /dev/video7: in use by notebook (7)."
