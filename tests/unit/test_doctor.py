"""Each failure is one sentence that says what to do."""

import json
import os
import pty
import subprocess
import sys
import tty

import pytest
from test_jetbot_pro import REPORT

from conftest import SOURCE
from jetbot import computer, doctor
from jetbot.fake_i2c import power_on


def lines(buses=(), port="/dev/nowhere"):
    return [str(check) for check in doctor.examine(buses, port)]


@pytest.fixture(autouse=True)
def installed(monkeypatch):
    monkeypatch.setattr(doctor, "PACKAGES", {"json": "python3"})


def test_a_machine_with_nothing(monkeypatch):
    monkeypatch.setattr(computer, "buses", lambda: [])
    monkeypatch.setattr(computer, "model", lambda: "")
    assert lines() == [
        "ok  json: installed.",
        "ok  computer: not one of those that a JetBot carries.",
        "NOT I2C buses: there is no /dev/i2c-*. On a Raspberry Pi switch I2C on with: sudo raspi-config"
        "   On a PC there is none: use i2c_bus:=fake",
        "NOT /dev/nowhere: there is no serial port /dev/nowhere. Is the board plugged in and switched on?",
        "NOT robot: no motor board found. To try everything without one: i2c_bus:=fake"]


def test_a_board_that_answers(folder):
    power_on(folder)
    (folder / "0x5d").unlink()
    found = lines([f"fake:{folder}"])
    assert f"ok  0x60 on bus fake:{folder}: answers, and can be a board jetbot or adafruit or waveshare." in found
    assert f"NOT 0x5d on bus fake:{folder}: no answer from 0x5d on fake:{folder}. To plug it in: " in found[3]
    assert found[-1] == (f"ok  robot: drive it with: roslaunch jetbot_control_node jetbot_controller.launch "
                         f"board:=jetbot i2c_bus:=fake:{folder}.")


def test_a_missing_package(folder, monkeypatch):
    monkeypatch.setattr(doctor, "PACKAGES", {"nosuchmodule": "python3-nosuchmodule"})
    found = lines([f"fake:{folder}"])
    assert found[0] == "NOT nosuchmodule: not installed. Install it with: sudo apt install python3-nosuchmodule"
    assert found[-1] == "NOT robot: cannot drive without nosuchmodule."


@pytest.mark.parametrize("group, advice", [
    ("root", "only root may open it. "
     "Give it to a group with: sudo apt install i2c-tools   then start the computer again."),
    ("daemon", "this user may not open it. Join its group with: sudo usermod -aG daemon $USER   and log in again.")])
def test_no_permission(tmp_path, monkeypatch, group, advice):
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    monkeypatch.setattr(doctor.grp, "getgrgid", lambda number: type("Group", (), {"gr_name": group}))
    assert str(doctor.check_permission(tmp_path)) == f"NOT {tmp_path}: {advice}"


def test_who_else_has_the_bus_open(tmp_path):
    bus = tmp_path / "i2c-1"
    bus.touch()
    assert doctor.check_users(bus).ok
    other = subprocess.Popen(["sleep", "60"], stdin=bus.open())
    try:
        assert str(doctor.check_users(bus)) == (
            f"NOT {bus}: also open in sleep ({other.pid}). Two programs on one motor board disturb each other: "
            "end one of them.")
    finally:
        other.kill()
        other.wait()


@pytest.mark.parametrize("sent, line", [
    (REPORT, "ok  {}: a JetBot Pro reports."),
    (b"login: ", "NOT {}: opens, but no JetBot Pro reports. Is it this port, and is the robot switched on?")])
def test_serial_port(sent, line, monkeypatch):
    monkeypatch.setattr(doctor, "LISTENING", 0.1)
    board, end = pty.openpty()
    tty.setraw(end)
    name = os.ttyname(end)
    original = doctor.SerialLink.read
    monkeypatch.setattr(doctor.SerialLink, "read", lambda link: (os.write(board, sent), original(link))[1])
    assert str(doctor.check_serial(name)) == line.format(name)
    os.close(board)
    os.close(end)


@pytest.mark.parametrize("plugged, code", [(True, 0), (False, 1)])
def test_json_and_exit_code(folder, plugged, code):
    power_on(folder)
    if not plugged:
        (folder / "0x60").unlink()
        (folder / "0x5d").unlink()
    before = sorted((path.name, path.read_bytes()) for path in folder.iterdir())
    run = subprocess.run([sys.executable, str(SOURCE / "scripts/doctor.py"), "--json", "--i2c-bus", f"fake:{folder}"],
                         env={**os.environ, "PYTHONPATH": os.pathsep.join([str(SOURCE / "src"), *sys.path])},
                         stdout=subprocess.PIPE, text=True)
    checks = json.loads(run.stdout)
    assert (checks[-1]["name"], checks[-1]["ok"]) == ("robot", plugged)
    assert run.returncode == code
    assert sorted((path.name, path.read_bytes()) for path in folder.iterdir()) == before, "it only reads"
