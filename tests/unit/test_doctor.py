"""Each failure is one sentence that says what to do."""

import json
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from conftest import REPORT, SOURCE
from jetbot import host
from jetbot.fake.bus import power_on
from jetbot_tools import doctor


def lines(bus=None, port="/dev/nowhere"):
    return [str(check) for check in doctor.examine(bus, port)]


@pytest.fixture(autouse=True)
def one_package_and_no_file(monkeypatch, tmp_path):
    monkeypatch.setattr(doctor, "PACKAGES", {"json": "json"})
    monkeypatch.setenv("ROS_HOME", str(tmp_path))


def test_a_machine_with_nothing(monkeypatch):
    monkeypatch.setattr(host, "buses", lambda: [])
    monkeypatch.setattr(host, "model", lambda: "")
    assert lines() == [
        "ok  json: installed.",
        "ok  computer: not one of those that a JetBot carries.",
        "NOT I2C buses: there is no /dev/i2c-*. "
        "On a Raspberry Pi switch I2C on with: sudo raspi-config   A PC has none.",
        "NOT /dev/nowhere: there is no serial port /dev/nowhere. Is the board plugged in and switched on?",
        "NOT robot: no motor board found. Mend what is NOT ok above. "
        "To try everything without one: roslaunch simulation simulation.launch"]


def test_a_board_that_answers(folder):
    power_on(folder)
    (folder / "0x5d").unlink()
    assert lines(f"fake:{folder}")[2:] == [
        f"ok  0x60 on bus fake:{folder}: answers, and can be a board jetbot or adafruit or waveshare.",
        "ok  robot: could drive. Start it with: roslaunch jetbot_control_node jetbot_controller.launch "
        f"board:=jetbot i2c_bus:=fake:{folder}"]


def test_a_bus_without_a_board(folder):
    folder.mkdir()
    assert lines(f"fake:{folder}")[2] == (f"NOT 0x60 on bus fake:{folder}: no answer from 0x60 on fake:{folder}. "
                                          f"To plug it in: python3 -m jetbot.fake {folder}")


def test_a_bus_that_cannot_be():
    assert lines("banana")[2] == ("NOT bus banana: i2c_bus cannot be 'banana'. "
                                  "Give a number (1 for /dev/i2c-1), fake, or fake:FOLDER.")


def test_the_bus_of_this_computers_robot_is_looked_at_first(monkeypatch):
    monkeypatch.setattr(host, "model", lambda: "NVIDIA Jetson Orin Nano Developer Kit")
    monkeypatch.setattr(host, "buses", lambda: [Path(f"/dev/i2c-{number}") for number in (0, 1, 7, 10)])
    assert doctor.all_buses() == [7, 0, 1, 10]


def test_another_chip_at_sparkfuns_address(folder):
    power_on(folder)
    (folder / "0x5d").write_bytes(bytes(256))
    assert str(doctor.check_address(f"fake:{folder}", 0x5D)) == (
        f"NOT 0x5d on bus fake:{folder}: what answers is no SparkFun motor driver. It is of no use for driving.")


@pytest.mark.parametrize("module, noetic, advice", [
    ("rospy", False, "Install it with: sudo apt install python3-rospy"),
    ("diagnostic_updater", False, "Install it with: sudo apt install python3-diagnostic-updater"),
    ("smbus2", True, "Install it with: pip3 install smbus2"),
    ("serial", True, "Install it with: sudo apt install python3-serial"),
    ("rospy", True, "Type: source {}/setup.bash   Or install it with: sudo apt install ros-noetic-rospy")])
def test_how_to_install_a_package(module, noetic, advice, tmp_path, monkeypatch):
    monkeypatch.undo()
    assert doctor.how_to_install(module, tmp_path if noetic else tmp_path / "none") == advice.format(tmp_path)


def test_only_packages_that_every_robot_needs_keep_it_from_driving(folder, monkeypatch):
    monkeypatch.setattr(doctor, "PACKAGES", {"nosuchmodule": "no-such-module"})
    found = lines(f"fake:{folder}")
    assert found[0] == "NOT nosuchmodule: not installed. Install it with: sudo apt install python3-no-such-module"
    assert found[-1] == "NOT robot: cannot drive as long as nosuchmodule is not ok."
    monkeypatch.setattr(doctor, "NOT_FOR_EVERY_ROBOT", ["nosuchmodule"])
    assert lines(f"fake:{folder}")[-1].startswith("ok  robot: could drive.")


@pytest.mark.parametrize("text, line, last", [
    ("board: waveshare\ni2c_bus: BUS", "ok  FILE: names the board waveshare, and 0x60 on bus BUS answers.",
     "ok  robot: could drive. Start it with: roslaunch jetbot_control_node jetbot_controller.launch"),
    ("board: jetbot_pro\nport: /dev/nowhere", "NOT FILE: names the board jetbot_pro, but there is no serial port "
     "/dev/nowhere. Connect that board; or remove the file, and calibrate anew.",
     "NOT robot: cannot drive as long as FILE is not ok."),
    ("speed: 3", "NOT FILE: there is no parameter speed. Mend it, or remove it.",
     "NOT robot: cannot drive as long as FILE is not ok.")])
def test_the_file_of_parameters(folder, tmp_path, text, line, last):
    file, bus = tmp_path / "jetbot.yaml", f"fake:{folder}"
    file.write_text(text.replace("BUS", bus))
    found = lines(bus)
    assert line.replace("FILE", str(file)).replace("BUS", bus) in found
    assert found[-1] == last.replace("FILE", str(file))


@pytest.mark.parametrize("name, group, advice", [
    ("i2c-1", "daemon", "Join its group with: sudo usermod -aG daemon $USER   and log in again."),
    ("i2c-1", "root", "Give it to a group: sudo chgrp i2c {0} && sudo chmod g+rw {0}   "
                      "and join that: sudo usermod -aG i2c $USER   and log in again."),
    ("ttyACM0", "root", "Give it to a group: sudo chgrp dialout {0} && sudo chmod g+rw {0}   "
                        "and join that: sudo usermod -aG dialout $USER   and log in again."),
    ("i2c-1", None, "Its group has no name here, as in a container; start that with: --group-add {1}")])
def test_no_permission(tmp_path, monkeypatch, name, group, advice):
    def group_of(number):
        if not group:
            raise KeyError(number)
        return SimpleNamespace(gr_name=group)

    device = tmp_path / name
    device.touch()
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    monkeypatch.setattr(host.grp, "getgrgid", group_of)
    assert [str(check) for check in doctor.check_device(str(device))] == [
        f"NOT {device}: this user may not open it. " + advice.format(device, device.stat().st_gid)]


def test_who_else_has_the_bus_open(tmp_path):
    bus = tmp_path / "i2c-1"
    bus.touch()
    assert doctor.check_device(str(tmp_path / "none")) == []
    assert str(doctor.check_users(bus)).startswith(f"ok  {bus}: no other program")
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
def test_serial_port(port, sent, line, monkeypatch):
    monkeypatch.setattr(doctor, "LISTENING", 0.1)
    board, name = port
    original = doctor.SerialLink.read
    monkeypatch.setattr(doctor.SerialLink, "read", lambda link: (os.write(board, sent), original(link))[1])
    assert str(doctor.check_serial(name)) == line.format(name)


@pytest.mark.parametrize("plugged, code", [(True, 0), (False, 1)])
def test_json_and_exit_code(folder, plugged, code, tmp_path):
    power_on(folder)
    if not plugged:
        (folder / "0x60").unlink()
        (folder / "0x5d").unlink()
    before = sorted((path.name, path.read_bytes()) for path in folder.iterdir())
    ros = tmp_path / "ros"
    ros.mkdir()
    for module in ("rospy", "diagnostic_updater", "nav_msgs", "sensor_msgs", "tf2_ros"):
        (ros / f"{module}.py").touch()  # installed, on a computer without ROS too
    run = subprocess.run([sys.executable, str(SOURCE / "scripts/doctor.py"), "--json"],
                         env={**os.environ, "PYTHONPATH": os.pathsep.join([str(SOURCE / "src"), *sys.path, str(ros)]),
                              "ROS_HOME": str(folder), "JETBOT_I2C_BUS": f"fake:{folder}"},
                         stdout=subprocess.PIPE, text=True)
    checks = json.loads(run.stdout)
    assert (checks[-1]["name"], checks[-1]["ok"]) == ("robot", plugged)
    assert run.returncode == code
    assert sorted((path.name, path.read_bytes()) for path in folder.iterdir()) == before, "it only reads"
