"""What the doctor says of the camera: which there is, who uses it, whether a picture comes."""

import re
from functools import partial

import pytest
from examined import lines, make_bare

from jetbot import host
from jetbot.camera import sources, stream
from jetbot_tools.doctor import camera_check

PICTURE = r'printf "\377\330\377\332\000\002picture\377\331"; sleep 60'


@pytest.fixture(autouse=True)
def bare(monkeypatch, tmp_path):
    make_bare(monkeypatch, tmp_path)


def plug_in(tmp_path, number, driver, index):
    video = tmp_path / f"video4linux/video{number}"
    (tmp_path / driver).mkdir(exist_ok=True)
    (video / "device").mkdir(parents=True)
    (video / "device/driver").symlink_to(tmp_path / driver)
    (video / "index").write_text(f"{index}\n")


@pytest.mark.parametrize("model, sources", [("", ["/dev/video2"]), ("Raspberry Pi 5", ["csi", "/dev/video2"])])
def test_which_cameras_there_may_be(monkeypatch, tmp_path, model, sources):
    for number, driver, index in (0, "bcm2835-codec", 0), (2, "uvcvideo", 0), (3, "uvcvideo", 1):
        plug_in(tmp_path, number, driver, index)
    (tmp_path / "video4linux/video4").mkdir()
    monkeypatch.setattr(host, "model", lambda: model)
    monkeypatch.setattr(camera_check, "check_camera", lambda source, _: source)
    assert list(camera_check.check_cameras()) == sources
    monkeypatch.setenv("JETBOT_CAMERA", "fake")
    assert list(camera_check.check_cameras()) == ["fake"]


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
    ("Permission denied", "", "NOT camera /dev/video2: this user may not use the camera. Join its group:")])
def test_a_camera_that_is_not_there_is_a_fault_if_it_is_named(monkeypatch, tmp_path, printed, named, line):
    plug_in(tmp_path, 2, "uvcvideo", 0)
    monkeypatch.setenv("JETBOT_CAMERA", named)
    usb = sources.Source("sh", f"echo {printed} >&2", troubles=sources.TROUBLES)
    monkeypatch.setitem(sources.SOURCES, "usb", [usb])
    assert lines()[-2].startswith(line)


def test_that_there_is_no_camera_is_no_fault():
    assert [str(check) for check in camera_check.check_cameras()] == ["ok  camera: none found."]


def test_who_uses_the_camera(monkeypatch, tmp_path):
    for pid, program in (7, "notebook"), (8, "nvargus-daemon"):
        (tmp_path / f"{pid}/fd").mkdir(parents=True)
        (tmp_path / f"{pid}/fd/3").symlink_to("/dev/video7")
        (tmp_path / f"{pid}/cmdline").write_text(f"/usr/bin/{program}\0")
    monkeypatch.setattr(camera_check, "users_of", partial(camera_check.users_of, proc=tmp_path))
    monkeypatch.setenv("JETBOT_CAMERA", "/dev/video7")
    assert lines()[-2] == "ok  camera /dev/video7: in use by notebook (7)."


def test_a_name_that_is_no_camera(monkeypatch):
    monkeypatch.setenv("JETBOT_CAMERA", "web")
    assert lines()[-2].startswith("NOT camera web: a camera cannot be 'web'. Give csi, usb,")
