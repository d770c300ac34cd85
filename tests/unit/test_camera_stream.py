"""JPEGs from a child process, cut out of what it writes; it is started again when it ends, hangs or writes garbage."""

import os
import shlex
import shutil
import subprocess
import sys

import pytest

from conftest import PYTHONPATH
from jetbot import InvalidValue, JetbotError
from jetbot.camera import sources, stream
from jetbot.camera.jpeg import MAX_SIZE, take
from jetbot.camera.sources import find_command
from jetbot.wait import wait_until
from jetbot_camera.camera_parameters import PARAMETERS
from jetbot_ros.node_parameters import check_values

HEAD, SCAN = b"\xff\xd8\xff\xe0\x00\x04ab", b"\xff\xda\x00\x02"


def jpeg(data=b"", extra=b""):
    """Return what is a JPEG for who does not decode it."""
    return HEAD + extra + SCAN + data + b"\xff\xd9"


def taken(buffer):
    """Return all complete pictures of a buffer."""
    return list(iter(lambda: take(buffer), None))


THUMBNAIL = b"\xff\xe1" + (2 + len(jpeg(b"small"))).to_bytes(2, "big") + jpeg(b"small")


@pytest.mark.parametrize("written, pictures", [
    (jpeg(b"1") + jpeg(b"2"), [jpeg(b"1"), jpeg(b"2")]),
    (b"GST_ARGUS: Creating output stream\n\xff\xd8\xff" + jpeg(b"1"), [jpeg(b"1")]),
    (jpeg(b"1")[:-2] + jpeg(b"2"), [jpeg(b"2")]),
    (HEAD[:4] + b"\0\0" + jpeg(b"2"), [jpeg(b"2")]),
    (jpeg(b"1", THUMBNAIL), [jpeg(b"1", THUMBNAIL)]),
    (jpeg(b"\xff\x00\xff\xd0"), [jpeg(b"\xff\x00\xff\xd0")]),
    (jpeg(b"1")[:-1], []),
    (b"\xff\xd8" * 20, []),
    (HEAD[:5] + 20 * jpeg(b"2"), 20 * [jpeg(b"2")]),  # a head that is cut costs few pictures
])
@pytest.mark.parametrize("step", [1, 7, 1000])
def test_pictures_are_cut_out_of_a_stream(written, pictures, step):
    buffer, found = bytearray(), []
    for start in range(0, len(written), step):
        buffer += written[start:start + step]
        found += taken(buffer)
    assert found == pictures


@pytest.mark.parametrize("start", [b"", HEAD, HEAD + SCAN])
def test_what_is_no_picture_takes_no_memory(start):
    buffer = bytearray(start)
    for _ in range(50):
        buffer += bytes(1024 * 1024)
        assert take(buffer) is None
        assert len(buffer) <= MAX_SIZE
    buffer += b"\xff\xd9" + jpeg(b"2")
    assert take(buffer) == jpeg(b"2")


@pytest.fixture
def follow(tmp_path, monkeypatch):
    """Follows a child that runs Python code; returns the stream and what it reports. Each start is a byte of a file."""
    monkeypatch.setattr(stream, "START_TIMEOUT", 5.0)
    monkeypatch.setattr(stream, "TIMEOUT", 1.0)
    monkeypatch.setattr(stream, "RESTART_INTERVAL", 0.1)
    streams = []

    def start(code):
        program = tmp_path / "child.py"
        program.write_text(f"""\
import array, fcntl, os, signal, sys, termios, time
with open({str(tmp_path / "starts")!r}, "ab") as file:
    file.write(b".")
    first = file.tell() == 1
def write(data):
    os.write(1, data) if len(data) < 60000 else (sys.stdout.buffer.write(data), sys.stdout.buffer.flush())
def picture(data):
    write({HEAD + SCAN!r} + data + {jpeg()[-2:]!r})
{code}""")
        reports = []
        streams.append(stream.Stream(find_command(f"command:exec {shlex.quote(sys.executable)} {program}"),
                                     reports.append))
        streams[-1].start()
        return streams[-1], reports

    yield start
    for each in streams:
        each.stop()


@pytest.mark.parametrize("misbehaviour, sentence", [
    ("time.sleep(60)", "No picture came from the camera for 1 s."),
    ("os.close(1); time.sleep(60)", "The camera's program has ended. Try the command by itself."),
    ("sys.exit('v4l2src: Device is busy')", "The camera's program sends no pictures: v4l2src: Device is busy. Try the"),
    ("os.kill(os.getpid(), 9)", "The camera's program has ended."),
    ("while True: write(os.urandom(50000).replace(b'\\xff\\xd8', b''))", "No picture came from the camera for 1 s."),
    ("write(b'\\xff\\xd8\\xff\\xda\\0\\2half'); time.sleep(60)", "No picture came from the camera for 1 s."),
    ("while True: picture(bytes(50000000))", "No picture came from the camera for 1 s."),
], ids=["hangs", "closes", "busy", "killed", "garbage", "half", "50 MB"])
def test_a_child_that_misbehaves_is_reported_once_and_started_again(follow, misbehaviour, sentence):
    follower, reports = follow(f"""
left = array.array("i", [1])
os.write(2, b"is busy until the first picture, which is no reason then")
while left[0]: fcntl.ioctl(2, termios.FIONREAD, left)
picture(b"1")
if first:
    {misbehaviour}
picture(b"2")
time.sleep(600)""")
    assert wait_until(lambda: follower.newest == jpeg(b"2"), 20)
    assert len(reports) == 1 and reports[0].startswith(sentence)


def test_a_child_that_stutters_runs_on(follow, tmp_path, monkeypatch):
    monkeypatch.setattr(stream, "START_TIMEOUT", 3.0)
    monkeypatch.setattr(stream, "TIMEOUT", 5.0)
    follower, reports = follow("for number in range(10): picture(b'%d' % number); time.sleep(0.4)\ntime.sleep(600)")
    assert wait_until(lambda: follower.newest == jpeg(b"9"), 20) and reports == []


def test_a_child_that_never_sends_a_picture_is_an_error_which_is_reported_once(follow, tmp_path):
    follower, reports = follow("sys.exit('no such device')")
    with pytest.raises(JetbotError, match="^The camera's program sends no pictures: no such device"):
        follower.require_picture()
    assert wait_until(lambda: (tmp_path / "starts").stat().st_size > 3, 20)
    assert len(reports) == 1


def test_the_newest_picture_wins(follow):
    follower, _ = follow('[picture(b"%d" % number) for number in range(5000)]; time.sleep(60)')
    assert wait_until(lambda: follower.newest == jpeg(b"4999"), 20)


STUBBORN = "signal.signal(signal.SIGINT, signal.SIG_IGN)\n"


@pytest.mark.parametrize("code", ["", STUBBORN])
def test_what_is_stopped_leaves_no_process_also_in_a_session_of_its_own(follow, code):
    follower, _ = follow(code + """
import subprocess
other = subprocess.Popen(["sleep", "600"], start_new_session=True)
picture(b"%d %d" % (os.getpgrp(), other.pid))
time.sleep(600)""")
    follower.require_picture()
    groups = [int(group) for group in follower.newest[len(HEAD + SCAN):-2].split()]
    assert all(map(is_running, groups))
    follower.stop()
    assert wait_until(lambda: not any(map(is_running, groups)), 10) and list(follower) == []


@pytest.mark.parametrize("end, rest", [
    ("pictures.abandon()", ""), ("os.kill(os.getpid(), 9)", "; true")], ids=["leaves", "is killed above a shell"])
def test_a_program_that_ends_at_once_leaves_no_process(tmp_path, end, rest):
    child, program = tmp_path / "child.py", tmp_path / "program.py"
    child.write_text(f"import os, signal, time\n{STUBBORN}"
                     f"os.write(1, {HEAD + SCAN!r} + b'%d' % os.getpgrp() + {jpeg()[-2:]!r})\ntime.sleep(600)")
    program.write_text(f"""\
import os
from jetbot.camera import sources, stream
pictures = stream.Stream(sources.find_command("command:{sys.executable} {child}{rest}"))
pictures.start()
pictures.require_picture()
print(pictures.newest[{len(HEAD + SCAN)}:-2].decode(), flush=True)
{end}""")
    environment = {**os.environ, "PYTHONPATH": PYTHONPATH}
    group = int(subprocess.run([sys.executable, program], env=environment, stdout=subprocess.PIPE).stdout)
    assert is_running(group)
    assert wait_until(lambda: not is_running(group), 20)


def is_running(group):
    """Return whether a process of this group runs; one that nobody has waited for does not."""
    listed = subprocess.run(["ps", "-A", "-o", "pgid=,stat="], stdout=subprocess.PIPE, text=True, check=True).stdout
    return any(int(row.split()[0]) == group and "Z" not in row for row in listed.splitlines())


@pytest.mark.parametrize("name, printed, sentence", [
    *(("usb", *trouble) for trouble in [
        ('WARNING: erroneous pipeline: no element "nvargus"', "GStreamer has not what a Jetson's CSI camera needs"),
        ('WARNING: erroneous pipeline: no element "v4l2src"', "GStreamer has no element v4l2src. Install: sudo apt"),
        ("Cannot identify device '/dev/video0'.", "There is no such camera. Is it connected? Without"),
        ("ERROR: *** no cameras available ***", "There is no such camera"),
        ("v4l2_open failed: Permission denied", "This user may not use the camera. Join its group: sudo usermod"),
        ("Error generated. argus: Failed to create CaptureSession",
         "The camera's daemon does not answer. Try: sudo systemctl restart nvargus-daemon"),
        ("something else\n", "The camera's program sends no pictures: something else")]),
    ("fake", "Permission denied", "The camera's program sends no pictures: Permission denied."),
    ("file:x", "Permission denied", "The camera's program sends no pictures: Permission denied."),
    ("command:x", "Permission denied", "The camera's program sends no pictures: Permission denied. Try the command")])
def test_each_known_trouble_of_a_camera_has_its_sentence(name, printed, sentence):
    usb, = sources.SOURCES["usb"]
    command = sources.Command("", usb) if name == "usb" else find_command(name)
    assert str(command.explain(printed.encode(), "")).startswith(sentence)


@pytest.mark.parametrize("name, programs, words", [
    ("csi", {"rpicam-vid", "gst-launch-1.0"}, "exec rpicam-vid --codec mjpeg --mode 1640:1232 --width 320 --height"),
    ("csi", {"libcamera-vid"}, "exec libcamera-vid --codec mjpeg"),
    ("csi", {"gst-launch-1.0"}, "exec gst-launch-1.0 -q nvarguscamerasrc sensor-mode=3 ! "),
    ("usb", {"gst-launch-1.0"}, "exec gst-launch-1.0 -q v4l2src device=/dev/video0 ! "),
    ("/dev/video2", {"gst-launch-1.0"}, "exec gst-launch-1.0 -q v4l2src device=/dev/video2 ! "),
    ("command:ffmpeg {x}", {"sh"}, "ffmpeg {x}"),
])
def test_a_name_means_a_command(monkeypatch, name, programs, words):
    monkeypatch.setattr(sources.shutil, "which", lambda program: program if program in programs else None)
    assert find_command(name, 320, 240, 20).line.startswith(words)


@pytest.mark.skipif(not shutil.which("gst-launch-1.0"), reason="GStreamer is not installed: gstreamer1.0-tools")
@pytest.mark.parametrize("flip", [False, True])
def test_a_camera_on_usb_runs_with_a_test_picture_for_it(flip):
    usb = find_command("usb", 64, 48, 10, flip=flip)
    follower = stream.Stream(usb._replace(line=usb.line.replace("v4l2src device=/dev/video0 ! decodebin",
                                                                "videotestsrc is-live=true ! video/x-raw,width=320")))
    follower.start()
    try:
        follower.require_picture()
        pictures = [picture for picture, _ in zip(follower, range(3))]
    finally:
        follower.stop()
    assert len(pictures) == 3
    assert all(b"\0\x30\0\x40\x03" in picture for picture in pictures)  # of start of frame: height, width, components


def test_a_program_that_is_missing_is_named(monkeypatch):
    monkeypatch.setattr(sources.shutil, "which", lambda program: None)
    with pytest.raises(JetbotError, match="^The program gst-launch-1.0 is missing. Install: sudo apt install gst"):
        find_command("usb")


@pytest.mark.parametrize("name", ["web", "fake:1", "file:", "command", "usb:2", "csi:0"])
def test_what_is_no_source_is_refused(name):
    with pytest.raises(InvalidValue, match="^A camera cannot be "):
        find_command(name)


@pytest.mark.parametrize("given", [
    {"fps": 29.97}, {"width": 224.5}, {"width": 0}, {"height": "8; reboot"}, {"quality": 96}], ids=str)
def test_a_number_that_cannot_be_is_refused(given):
    name, = given
    with pytest.raises(InvalidValue, match=f"^The {name} must be a whole number from 1 to "):
        find_command("fake", **given)


@pytest.mark.parametrize("given", [
    {"width": 0}, {"height": 5000}, {"fps": 0.5}, {"fps": True}, {"quality": 96}, {"flip": "yes"}, {"source": 3},
    {"brightness": 1}], ids=str)
def test_what_cannot_be_is_refused(given):
    with pytest.raises(InvalidValue):
        check_values(given, PARAMETERS)
