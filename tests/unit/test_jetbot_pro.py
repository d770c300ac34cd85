"""Frames of the JetBot Pro, to the byte, and how it finds them in noise."""

import os
import select
import struct
import termios
from contextlib import suppress
from pathlib import Path
from random import Random
from unittest.mock import Mock

import pytest

from jetbot import BusError, InvalidValue
from jetbot.boards import find_board
from jetbot.boards.jetbot_pro import FrameReader, frame, velocity
from jetbot.connection import open_board
from jetbot.fake.chips import JetBotPro, decode
from jetbot.serial_link import SerialLink
from jetbot.wait import wait_until

# A telemetry frame of the JetBot Pro: gyro and acceleration, x, y and yaw.
BODY = (b"\xaa\x55\x2d\x01" + struct.pack(">6h", 16384, 0, -16384, 0, 0, 16384) + bytes(6)
        + struct.pack(">3h", 1500, -250, 785) + bytes(16))
TELEMETRY = BODY + bytes([sum(BODY) % 256])
TIMEOUT = 5.0  # s
CHANGES = 1_000


@pytest.mark.parametrize("left, right, bytes_", [
    (0, 0, "aa550b11000000000000" "1b"),
    (0.4, 0.6, "aa550b1101f400000064" "74"),   # 500 mm/s, 100 mrad/s
    (-1, -1, "aa550b11fc1800000000" "2f"),     # -1000 mm/s
    (1, -1, "aa550b1100000000fc18" "2f"),      # -1000 mrad/s
    (-0.5, 1.5, "aa550b1101f4000003e8" "fb"),  # 500 mm/s, 1000 mrad/s: a Twist of (0.5, 1.0)
    (32.767, 32.767, "aa550b117fff00000000" "99"),
])
def test_velocity(left, right, bytes_):
    assert velocity(left, right).hex() == bytes_


@pytest.mark.parametrize("step", [1, 1000])
@pytest.mark.parametrize("noise", [
    b"", b"\x00", b"\xaa", b"\xaa\x55", b"\xaa\x55\x2d", b"\xaa\x55\xff\x01", b"\xaa\x55\x00\x01",
    TELEMETRY[:-1] + b"\x00", TELEMETRY[:20], bytes(range(256))])
def test_finds_the_frames_after_noise_also_byte_by_byte(noise, step):
    reader, data = FrameReader(), noise + TELEMETRY + TELEMETRY + TELEMETRY
    frames = [frame for start in range(0, len(data), step) for frame in reader.feed(data[start:start + step])]
    assert len(frames) >= (2 if noise else 3)
    assert set(frames) == {(0x01, TELEMETRY[4:-1])}


def read(end, count):
    data = b""
    while len(data) < count and select.select([end], [], [], TIMEOUT)[0]:
        data += os.read(end, count - len(data))
    return data


def test_driving_sends_changes_and_keep_alive_repeats(port):
    end, name = port
    board = open_board(find_board("jetbot_pro"), name)
    settings = bytes.fromhex("aa550b12015e00780000f3" "aa550913" "03e803e8" "f1")  # 350, 120, 0; 1000, 1000
    assert read(end, 31) == settings + velocity(0, 0)
    board.drive(0.4, 0.6)
    board.drive(0.4, 0.6)
    board.keep_alive()
    assert read(end, 22) == velocity(0.4, 0.6) * 2
    board.close()


def test_a_frame_that_is_cut_at_any_byte_drives_at_no_speed_that_was_not_commanded(monkeypatch):
    """The board may take the next frames for the rest of that one, if the sum fits. What is lost counts as zero."""
    random, sent = Random(1), []
    monkeypatch.setattr(SerialLink, "write", lambda link, data: sent.append(data))
    driver = open_board(find_board("jetbot_pro"), "/dev/ttyACM0")
    for _ in range(CHANGES):
        wheels = random.uniform(-2, 2), random.uniform(-2, 2)
        with monkeypatch.context() as patch, pytest.raises(BusError):
            patch.setattr(SerialLink, "write", Mock(side_effect=BusError("cut")))
            driver.drive(*wheels)
        sent.clear()
        driver.drive(0.25, 0.25)
        whole = velocity(*wheels)
        for cut in range(1, len(whole)):
            board = JetBotPro()
            board.receive(whole[:cut] + b"".join(sent))
            lost = decode(whole[:cut].ljust(len(whole), b"\0"))
            assert set(board.velocities) <= {decode(whole), lost, (0, 0), (250, 0)}, (wheels, cut)
            assert board.velocities[-1] == (250, 0)


def test_telemetry_in_units(port):
    end, name = port
    board = open_board(find_board("jetbot_pro"), name)
    telemetry = []
    board.listen(telemetry.append)
    os.write(end, b"noise" + frame(0x01) + TELEMETRY)  # whole, but too short for telemetry
    assert wait_until(lambda: telemetry, TIMEOUT)
    assert (telemetry[0].x, telemetry[0].y, telemetry[0].yaw) == (1500, -250, 785)
    assert telemetry[0].gyro == pytest.approx((17.4533, 0, -17.4533), abs=1e-4)
    assert telemetry[0].acceleration == pytest.approx((0, 0, 9.80665))
    board.close()


def test_a_file_is_no_port(tmp_path):
    (tmp_path / "port").touch()
    with pytest.raises(BusError, match="is not a serial port. Give a serial device such as /dev/ttyACM0.$"):
        open_board(find_board("jetbot_pro"), str(tmp_path / "port"))


@pytest.mark.parametrize("url", [
    "spy:///dev/ttyACM0?file=/tmp/x", "SPY://x", "alt:///dev/ttyACM0?class=x", "hwgrep://.*", "cp2110://x",
    "://x", "os.path://x"])
def test_a_url_that_is_refused(url):
    with pytest.raises(InvalidValue, match="^A serial port cannot be .*. Give a device such as /dev/ttyACM0, a URL"):
        SerialLink(url)


@pytest.mark.parametrize("url", ["socket://localhost:1", "rfc2217://localhost:1", "RFC2217://localhost:1"])
def test_a_url_of_a_network_port(url):
    with pytest.raises(BusError, match="^No answer from "):
        SerialLink(url).write(b"x")


@pytest.mark.parametrize("by_the_listener", [True, False])
def test_closing_while_it_listens_leaves_the_port_closed(port, by_the_listener):
    end, name = port
    driver = open_board(find_board("jetbot_pro"), name)
    driver.listen(lambda telemetry: driver.close())
    assert is_open(name)
    os.write(end, TELEMETRY) if by_the_listener else driver.close()
    assert wait_until(lambda: not is_open(name), TIMEOUT)


def is_open(name):
    """Whether this process has the device open, beside the test."""
    count = 0
    for descriptor in Path("/proc/self/fd").iterdir():
        with suppress(FileNotFoundError):  # it was closed meanwhile
            count += os.readlink(descriptor) == name
    return count > 1


@pytest.mark.parametrize("failure", [termios.error(5, "Input/output error"), OSError(5, "Input/output error")])
def test_a_port_that_goes_while_it_is_opened(port, monkeypatch, failure):
    monkeypatch.setattr(termios, "tcflush", Mock(side_effect=failure))
    with pytest.raises(BusError, match=f"^No answer from {port[1]}. "):
        SerialLink(port[1]).write(b"x")


def test_a_signal_handler_may_write_while_the_port_is_opened(port, monkeypatch):
    link = SerialLink(port[1])
    flush = termios.tcflush

    def interrupted(*arguments):
        monkeypatch.setattr(termios, "tcflush", flush)
        link.write(b"handler ")

    monkeypatch.setattr(termios, "tcflush", interrupted)
    link.write(b"program")
    assert read(port[0], 15) == b"handler program"
