"""The doctor prints one line per check; each failure is one sentence with its fix."""

import json
import os
import subprocess
import sys
from types import SimpleNamespace

import pytest
from examined import lines, make_bare

from conftest import PYTHONPATH, TOOLS
from jetbot import host
from jetbot.fake import chip_file
from jetbot.fake.bus import power_on
from jetbot.serial_link import SerialLink
from jetbot_tools.doctor import checkup, computer, motor_board

COULD_DRIVE = "ok  robot: could drive. Start it with: roslaunch jetbot_control_node jetbot_controller.launch"


@pytest.fixture(autouse=True)
def bare(monkeypatch, tmp_path):
    make_bare(monkeypatch, tmp_path)


def test_a_computer_with_nothing():
    assert lines() == [
        "ok  json: installed.",
        "ok  computer: not one of those that a JetBot carries.",
        "NOT I2C buses: there is no /dev/i2c-*. "
        "On a Raspberry Pi switch I2C on with: sudo raspi-config   A PC has none.",
        "NOT /dev/nowhere: there is no serial port /dev/nowhere. Is the board plugged in and switched on?",
        "NOT robot: no motor board found. Fix the items marked NOT. "
        "To try everything without one: roslaunch simulation simulation.launch"]


def test_a_board_that_answers(folder):
    power_on(folder)
    for chip in set(folder.glob("0x*")) - {chip_file(folder, 0x60)}:
        chip.unlink()
    assert lines(f"fake:{folder}")[2:] == [
        f"ok  0x60 on fake:{folder}: answers, and can be a board jetbot or adafruit or waveshare. "
        "jetbot drives both layouts; Waveshare's boards from before August 2020 have Adafruit's.",
        f"{COULD_DRIVE} i2c_bus:=fake:{folder}"]


def test_a_jetbot_pro_that_reports_and_a_serial_port_with_something_else(folder, monkeypatch):
    assert lines(port=f"fake:{folder}")[2:] == [
        f"ok  fake:{folder}: a JetBot Pro reports.", f"{COULD_DRIVE} board:=jetbot_pro port:=fake:{folder}"]
    monkeypatch.setattr(motor_board, "TELEMETRY_TIMEOUT", 0.1)
    monkeypatch.setattr(SerialLink, "read", lambda link: b"login: ")
    assert lines(port=f"fake:{folder}")[2] == (
        f"NOT fake:{folder}: opens, but no JetBot Pro reports. Is it this port, and is the robot switched on?")


def test_only_packages_that_every_robot_needs_keep_it_from_driving(folder, monkeypatch):
    monkeypatch.setattr(checkup, "MODULES", ["no_such_module"])
    output = lines(f"fake:{folder}")
    assert output[0] == "NOT no_such_module: not installed. Install it with: sudo apt install python3-no-such-module"
    assert output[-1] == "NOT robot: cannot drive as long as no_such_module is not ok."
    monkeypatch.setattr(checkup, "NEEDED_BY_SOME", ["no_such_module"])
    assert lines(f"fake:{folder}")[-1].startswith("ok  robot: could drive.")


@pytest.mark.parametrize("text, line, last", [
    ("board: waveshare\ni2c_bus: BUS", "ok  FILE: names the board waveshare, and 0x60 on BUS answers.", COULD_DRIVE),
    ("board: jetbot_pro\nport: /dev/nowhere", "NOT FILE: names the board jetbot_pro, but there is no serial port "
     "/dev/nowhere. Connect that board; or remove the file, and calibrate again.",
     "NOT robot: cannot drive as long as FILE is not ok."),
    ("speed: 3", "NOT FILE: there is no parameter speed. Fix it, or remove it.",
     "NOT robot: cannot drive as long as FILE is not ok.")])
def test_the_file_of_parameters(folder, tmp_path, text, line, last):
    file, bus = tmp_path / "jetbot.yaml", f"fake:{folder}"
    file.write_text(text.replace("BUS", bus))
    output = lines()
    assert output[2].startswith(line.replace("FILE", str(file)).replace("BUS", bus))
    assert output[-1] == last.replace("FILE", str(file))


@pytest.mark.parametrize("bus, port", [("fake", None), (None, "fake")])
def test_a_fake_robot_does_not_use_the_real_ones_file(tmp_path, bus, port):
    (tmp_path / "jetbot.yaml").write_text("speed: 3")
    assert lines(bus, port)[-1].startswith("ok  robot: could drive.")


@pytest.mark.parametrize("plugged, code", [(True, 0), (False, 1)])
def test_json_and_exit_code(folder, plugged, code):
    if plugged:
        pytest.importorskip("rospy")  # without it no robot can be driven
    power_on(folder)
    for file in [] if plugged else list(folder.iterdir()):
        file.unlink()
    before = {file: file.read_bytes() for file in folder.iterdir()}
    ended = subprocess.run([sys.executable, str(TOOLS / "scripts/doctor.py"), "--json"], stdout=subprocess.PIPE,
                           env={**os.environ, "PYTHONPATH": PYTHONPATH, "JETBOT_I2C_BUS": f"fake:{folder}"})
    assert ended.returncode == code
    robot = json.loads(ended.stdout)[-1]
    assert (robot["name"], robot["ok"]) == ("robot", plugged)
    assert {file: file.read_bytes() for file in folder.iterdir()} == before, "it only reads"


@pytest.mark.parametrize("word, line", [
    ("5000", "NOT Battery: 10.2 V, about 34 %, by the INA219 at 0x41 on BUS. Charge it before the lesson."),
    ("0000", "ok  Battery: 0.00 V, by the INA219 at 0x41 on BUS.")])
def test_the_battery_that_a_chip_beside_the_board_measures(folder, word, line):
    power_on(folder)
    chip_file(folder, 0x41).write_bytes(bytes.fromhex(f"399F 0000 {word} 0000 0000 0000"))
    assert lines(f"fake:{folder}")[-2] == line.replace("BUS", f"fake:{folder}")
    assert lines(f"fake:{folder}")[-1].startswith("ok  robot: could drive.")


def test_what_the_computer_measures_is_checked_but_not_for_a_fake_robot(folder, monkeypatch):
    robots = SimpleNamespace(read=lambda: {"celsius": 48.0, "input_volts": 4.6, "undervoltage": 1})
    monkeypatch.setattr(checkup, "check_health", lambda: computer.check_health(robots))
    measured = [
        "ok  Temperature: 48 °C.",
        "NOT Supply of the computer: 4.60 V, which is too low. Charge the battery, or use a supply of 5 V and 4 A with "
        "a short cable.",
        "NOT undervoltage: The supply of the computer is too weak. Charge the battery, or use a stronger supply with a "
        "short cable."]
    assert set(measured) <= set(lines(port="/dev/nowhere"))
    power_on(folder)
    assert not set(measured) & set(lines(f"fake:{folder}"))


@pytest.mark.parametrize("cgroup, cmdline, display", [
    ("0::/system.slice/jetbot_stats.service", "python3", True), ("0::/docker/1", "python3 -m jetbot.apps.stats", True),
    ("0::/user.slice", "/usr/bin/python3 /home/jetbot/jetbot/jetbot/apps/stats.py", True),
    ("0::/user.slice", "python3 drive.py", False)])
def test_another_program_that_has_a_device_open_is_named_unless_it_is_the_jetbots_display(tmp_path, cgroup, cmdline,
                                                                                         display):
    device, process = tmp_path / "i2c-1", tmp_path / "proc/7"
    assert computer.check_users(str(device)) == []
    device.touch()
    (process / "fd").mkdir(parents=True)
    (process / "fd/3").symlink_to(device)
    (process / "cgroup").write_text(cgroup + "\n")
    (process / "cmdline").write_text(cmdline.replace(" ", "\0") + "\0")
    [check] = computer.check_users(str(device), tmp_path / "proc")
    assert check.ok == display
    assert ("also open in drive.py (7)" in check.finding) != display


@pytest.mark.parametrize("processes, name, finding", [
    ([7], "other.py", ["NOT port {0}: in use by other.py (7). The cockpit needs another one: cockpit_port:={1}"]),
    ([], "", ["NOT port {0}: in use by a program of another user. The cockpit needs another one: cockpit_port:={1}"]),
    ([7], "cockpit.py", [])])
def test_who_has_the_port_of_the_cockpits_page(monkeypatch, processes, name, finding):
    monkeypatch.setattr(computer, "is_free", lambda port: False)
    monkeypatch.setattr(computer, "processes_on", lambda port: processes)
    monkeypatch.setattr(host, "program_name", lambda pid: name)
    assert list(map(str, computer.check_cockpit_port(8080))) == [line.format(8080, 8081) for line in finding]
