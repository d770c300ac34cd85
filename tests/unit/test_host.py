import grp
import os
import subprocess
import sys
from types import SimpleNamespace

import pytest

from jetbot import host
from jetbot.wait import wait_until


@pytest.mark.parametrize("name, bus", [
    ("A PC", None), ("", None), ("NVIDIA Orin NX Developer Kit", 7), ("Jetson-AGX", 8), ("jetson-xavier", 8),
    ("quill", 1), ("jetson-nano", 1), ("NVIDIA Jetson Orin NX Engineering Reference Developer Kit Super", 7)])
def test_robot_bus_of_names_that_are_not_in_the_docs(name, bus):
    assert host.robot_bus(name) == bus


@pytest.mark.parametrize("name, expected", [
    ("Raspberry Pi 3 Model B Plus Rev 1.3", True), ("Raspberry Pi 4 Model B Rev 1.4", True),
    ("Raspberry Pi 400 Rev 1.0", True), ("Raspberry Pi Zero 2 W Rev 1.0", True),
    ("Raspberry Pi Compute Module 4 Rev 1.1", True), ("Raspberry Pi Compute Module 5 Rev 1.0", False),
    ("Raspberry Pi 5 Model B Rev 1.0", False), ("Raspberry Pi 500 Rev 1.0", False),
    ("NVIDIA Jetson Nano Developer Kit", False), ("", False)])
def test_which_computers_mishandle_a_stretched_clock(name, expected):
    assert host.mishandles_clock_stretching(name) == expected


def test_the_kernel_driver_that_holds_a_chip(tmp_path):
    (tmp_path / "1-0040").mkdir()
    (tmp_path / "1-0040/driver").symlink_to("../../../bus/i2c/drivers/ina3221")
    (tmp_path / "1-0060").mkdir()
    assert [host.kernel_driver(device, tmp_path) for device in ("1-0040", "1-0060", "7-0040")] == ["ina3221", "", ""]


def test_model(tmp_path):
    (tmp_path / "model").write_text("NVIDIA Jetson Nano Developer Kit\0")
    assert host.model(tmp_path / "model") == "NVIDIA Jetson Nano Developer Kit"
    assert host.model(tmp_path / "none") == ""


def test_buses_by_number(tmp_path):
    for name in ("i2c-10", "i2c-2", "i2c-1", "tty1"):
        (tmp_path / name).touch()
    assert host.buses(tmp_path) == [1, 2, 10]


@pytest.mark.parametrize("model, buses, sentence", [
    ("Jetson Nano", [0, 1], "This computer has /dev/i2c-0, /dev/i2c-1. "
     "On a Jetson Nano the motors are on i2c_bus 1."),
    ("", [], "This computer has no /dev/i2c-* at all."),
])
def test_bus_advice(monkeypatch, model, buses, sentence):
    monkeypatch.setattr(host, "model", lambda: model)
    monkeypatch.setattr(host, "buses", lambda: buses)
    assert host.bus_advice() == sentence


@pytest.mark.parametrize("name, group, advice", [
    ("i2c-1", "daemon", "Join its group with: sudo usermod -aG daemon $USER   and log in again."),
    ("i2c-1", "root", "Give it to a group: sudo chgrp i2c {0} && sudo chmod g+rw {0}   "
                      "and join that: sudo usermod -aG i2c $USER   and log in again."),
    ("i2c-1", None, "Its group has no name here, as in a container; start that with: --group-add {1}"),
    ("i2c-9", "daemon", "Join its group with: sudo usermod -aG i2c $USER   and log in again.")])
def test_permission_advice(tmp_path, monkeypatch, name, group, advice):
    (tmp_path / "i2c-1").touch()
    number = os.stat(tmp_path / "i2c-1").st_gid
    monkeypatch.setattr(grp, "getgrgid", {number: SimpleNamespace(gr_name=group)}.__getitem__ if group else {}.pop)
    assert host.permission_advice(tmp_path / name, "i2c") == advice.format(tmp_path / name, number)


@pytest.mark.parametrize("address", ["localhost", "127.0.0.1", "127.0.1.1", "::1", "0.0.0.0", "ThisRobot", "thisrobot"])
def test_addresses_of_this_computer(monkeypatch, address):
    monkeypatch.setattr(host.socket, "gethostname", lambda: "ThisRobot")
    assert host.is_this_host(address)


@pytest.mark.parametrize("address", [
    "203.0.113.7", "2001:db8::7", "::ffff:203.0.113.7", "localhost.example.org", "2130706433", "", None, [], 7.5])
def test_addresses_of_others_and_names_that_others_may_change(address):
    assert not host.is_this_host(address)


def test_loopback():
    assert [host.is_loopback(address) for address in ("localhost", "127.0.1.1", "::1", "robot.local", "10.0.0.2")] == [
        True, True, True, False, False]


@pytest.mark.parametrize("command, name", [
    ([sys.executable, "drive.py", "-x"], "drive.py"), (["/bin/sleep", "9"], "sleep"),
    ([sys.executable, "-c", "import drive"], os.path.basename(sys.executable))])
def test_the_name_of_a_program(tmp_path, command, name):
    (tmp_path / "drive.py").write_text("import time; time.sleep(9)")
    with subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.DEVNULL) as process:
        assert wait_until(lambda: host.program_name(process.pid) == name, timeout=5.0)
        process.kill()
