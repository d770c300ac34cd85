"""``Camera`` and ``bgr8_to_jpeg``, with fake cameras and children that write damaged pictures."""

import shlex
import sys
import threading

import pytest

from jetbot import InvalidValue, JetbotError
from jetbot.wait import wait_until

for package in ("traitlets", "numpy", "PIL"):
    pytest.importorskip(package)
import numpy  # noqa: E402
from PIL import Image  # noqa: E402

from jetbot import Camera, bgr8_to_jpeg  # noqa: E402
from jetbot.camera import camera, stream  # noqa: E402
from jetbot.camera.jpeg import decode  # noqa: E402
from jetbot.camera.sources import find_command  # noqa: E402

BLUE = numpy.zeros((48, 64, 3), numpy.uint8) + numpy.array([250, 20, 10], numpy.uint8)  # BGR


@pytest.fixture(autouse=True)
def cameras_end():
    yield
    for each in list(camera.running):
        each.stop()


CHILD = r"""import array, fcntl, os, termios, time
blue, red = (open(f"{FOLDER}/{name}.jpg", "rb").read() for name in ("blue", "red"))
def write(data):
    os.write(1, data)
def damaged():
    write(blue[:20] + b"\xff\xda\0\2\xff\xd9")
    left = array.array("i", [1])
    while left[0]: fcntl.ioctl(1, termios.FIONREAD, left)
def wait():
    while not os.path.exists(f"{FOLDER}/go"): time.sleep(0.01)
"""


@pytest.fixture
def command(tmp_path, monkeypatch):
    """Returns the source that runs Python code: write(JPEG), damaged() that is read by itself, wait() for a file go."""
    monkeypatch.setattr(stream, "RESTART_INTERVAL", 0.1)
    (tmp_path / "blue.jpg").write_bytes(bgr8_to_jpeg(BLUE))
    (tmp_path / "red.jpg").write_bytes(bgr8_to_jpeg(BLUE[:, :, ::-1]))

    def source(code):
        (tmp_path / "child.py").write_text(f"FOLDER = {str(tmp_path)!r}\n{CHILD}{code}")
        return f"command:exec {shlex.quote(sys.executable)} {tmp_path / 'child.py'}"

    return source


def is_blue(picture):
    return abs(picture.astype(int) - BLUE[0, 0]).max() < 12


def test_the_fake_camera_sees_a_floor_with_a_line(monkeypatch):
    monkeypatch.setenv("JETBOT_CAMERA", "fake")
    seen = Camera.instance(width=224, height=160)
    assert (seen.value.shape, seen.value.dtype) == ((160, 224, 3), numpy.uint8)
    sky, line, floor = seen.value[5, 112], seen.value[155, 112], seen.value[155, 5]
    assert sky[0] > 200 and line[2] > 200 > 100 > line[0] and 100 < floor.min() <= floor.max() < 150


def test_a_picture_becomes_a_jpeg_of_its_quality(tmp_path):
    noise = numpy.random.RandomState(1).randint(0, 255, (48, 64, 3)).astype(numpy.uint8)
    assert len(bgr8_to_jpeg(noise, quality=20)) < len(bgr8_to_jpeg(noise)) < len(bgr8_to_jpeg(noise, quality=95))
    (tmp_path / "blue.jpg").write_bytes(bgr8_to_jpeg(BLUE))
    with Image.open(tmp_path / "blue.jpg") as image:
        assert image.format == "JPEG" and image.getpixel((5, 5))[2] > 230


def test_observers_get_each_picture_until_they_leave(command):
    seen = Camera(64, 48, source=command("while True: write(blue); time.sleep(0.01)"))
    pictures = []
    observer = lambda change: pictures.append(change["new"])  # noqa: E731
    seen.observe(observer, names="value")
    assert wait_until(lambda: len(pictures) > 3, 10) and is_blue(pictures[0])
    seen.unobserve(observer, names="value")
    count = len(pictures)
    assert wait_until(lambda: seen.value is not pictures[-1], 10) and len(pictures) <= count + 1


def test_a_source_can_be_flipped(tmp_path):
    picture = BLUE.copy()
    picture[:24, :32] = 255 - BLUE[0, 0]
    (tmp_path / "1.jpg").write_bytes(bgr8_to_jpeg(picture, quality=95))
    for flip, corner in (False, picture[0, 0]), (True, picture[-1, -1]):
        pictures = stream.Stream(find_command(f"file:{tmp_path}", 64, 48, flip=flip))
        pictures.start()
        pictures.require_picture()
        pictures.stop()
        assert abs(decode(pictures.newest, 64, 48)[:20, :28].astype(int) - corner).max() < 40
    with pytest.raises(InvalidValue, match="^The pictures of a command cannot be flipped. Let the command itself"):
        find_command("command:true", flip=True)


def test_an_empty_folder_is_named_once(tmp_path, capsys):
    with pytest.raises(JetbotError, match=f"{tmp_path} has no pictures: .jpg or .png.$"):
        Camera(source=f"file:{tmp_path}")
    assert not camera.running and capsys.readouterr().err == ""


def test_stop_keeps_the_picture_and_start_sees_again(command):
    seen = Camera(64, 48, source=command("write(blue); time.sleep(60)"))
    seen.stop()
    seen.stop()
    last = seen.value
    assert is_blue(last) and not camera.running
    seen.restart()
    assert seen.value is not last and is_blue(seen.value)


def test_the_instance_is_the_camera_that_runs_with_the_same_arguments_and_another_one_of_its_source_stops_it(command):
    source = command("while True: write(blue); time.sleep(0.01)")
    seen = Camera.instance(64, 48, source=source)
    assert Camera.instance(width=64, height=48, source=source) is seen
    seen.stop()
    again = Camera.instance(64, 48, source=source)
    assert again is not seen and camera.running == [again]
    for make in Camera, Camera.instance:
        larger = make(128, 96, source=source)
        assert larger.value.shape == (96, 128, 3) and camera.running == [larger]


def test_a_damaged_picture_is_left_out_and_reported_be_it_the_first(command, tmp_path, capsys):
    seen = Camera(64, 48, source=command("damaged(); write(blue); wait(); damaged(); write(red); time.sleep(60)"))
    assert is_blue(seen.value)
    (tmp_path / "go").touch()
    assert wait_until(lambda: is_blue(seen.value[:, :, ::-1]), 10)
    assert capsys.readouterr().err.count("jetbot: The camera sends a damaged picture: cannot identify image") == 1


def test_a_camera_that_sends_damaged_pictures_only_is_none(command, monkeypatch):
    monkeypatch.setattr(stream, "START_TIMEOUT", 1.0)
    with pytest.raises(JetbotError, match="^No picture came from the camera for 1 s."):
        Camera(64, 48, source=command("while True: damaged()"))
    assert not camera.running


def test_an_observer_that_fails_or_may_stop_the_camera_ends_nothing_else(command):
    seen = Camera(64, 48, source=command("while True: write(blue); time.sleep(0.01)"))
    calls = []

    def fail(_):
        calls.append(1)
        if len(calls) > 3:
            seen.stop()
        raise RuntimeError

    seen.observe(fail, names="value")
    assert wait_until(lambda: len(calls) == 4 and not camera.running, 10)


def test_a_slow_observer_gets_the_newest_picture(command, tmp_path):
    seen = Camera(64, 48, source=command("write(blue); wait()\n"
                                         "for _ in range(300): write(blue); time.sleep(0.001)\n"
                                         "write(red); time.sleep(60)"))
    entered, leave, pictures = threading.Event(), threading.Event(), []

    def observer(change):
        pictures.append(change["new"])
        entered.set()
        leave.wait(20)

    seen.observe(observer, names="value")
    (tmp_path / "go").touch()
    assert entered.wait(10)
    jpegs = seen._stream
    assert wait_until(lambda: is_blue(jpegs.newest[:, :, ::-1]), 20)
    leave.set()
    assert wait_until(lambda: is_blue(pictures[-1][:, :, ::-1]), 10) and len(pictures) < 5
