"""The doctor prints one line per check; each failure is one sentence with its fix."""

import errno
import json
import os
import runpy
import signal
import subprocess
import sys
from functools import partial

import pytest

from conftest import SOURCE
from jetbot import host, i2c, supply
from jetbot.fake import chip_file
from jetbot.fake.bus import power_on
from jetbot.serial_link import SerialLink
from jetbot_tools import doctor, probe

PCA9685 = {0x00: 0x11, 0x01: 0x04, 0x02: 0xE2, 0x03: 0xE4, 0x04: 0xE8}
SCMD = {0x01: 0xA9}
LAUNCH = "roslaunch jetbot_control_node jetbot_controller.launch"


class Bus:
    """A bus that only reads. chips: {address: {register: byte}, or the number of the error}; read: the addresses."""

    def __init__(self, chips):
        self.chips, self.read = chips, []

    def read_byte_data(self, address, register):
        return self.read_i2c_block_data(address, register, 1)[0]

    def read_i2c_block_data(self, address, register, length):
        self.read.append(address)
        chip = self.chips.get(address, self.chips.get("any", errno.EREMOTEIO))
        if isinstance(chip, int):
            raise OSError(chip, "")
        return [chip.get(register + offset, 0) for offset in range(length)]

    def close(self):
        """Nothing to close."""


@pytest.fixture
def plug_in(monkeypatch):
    """Make this computer's /dev/i2c-N, all of them, a Bus with these chips, and return it."""
    def make(chips):
        bus = Bus(chips)
        monkeypatch.setattr(i2c, "open_bus", lambda name, *address: bus)
        return bus
    return make


def lines(bus=None, port=None, address=None, board=""):
    return [str(check) for check in doctor.run_checks(bus, port, address, board)]


@pytest.fixture(autouse=True)
def a_computer_with_one_package_and_no_device(monkeypatch, tmp_path):
    monkeypatch.setattr(doctor, "MODULES", ["json"])
    monkeypatch.setattr(doctor, "DEFAULT_PORT", "/dev/nowhere")
    monkeypatch.setattr(host, "buses", lambda: [])
    monkeypatch.setattr(host, "model", lambda: "")
    monkeypatch.setattr(i2c, "kernel_driver", lambda device: "")
    monkeypatch.setattr(supply, "on_computer", lambda sysfs: [])
    monkeypatch.setenv("ROS_HOME", str(tmp_path))


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
    for address in (0x40, 0x41, 0x5D):
        chip_file(folder, address).unlink()
    assert lines(f"fake:{folder}")[2:] == [
        f"ok  0x60 on fake:{folder}: answers, and can be a board jetbot or adafruit or waveshare. "
        "jetbot drives both layouts; Waveshare's boards from before August 2020 have Adafruit's.",
        "ok  robot: could drive. Start it with: roslaunch jetbot_control_node jetbot_controller.launch "
        f"i2c_bus:=fake:{folder}"]


@pytest.mark.parametrize("word, line", [
    ("5E88", "ok  supply: 12.10 V, 86 %, by the INA219 at 0x41 on BUS."),
    ("4846", "NOT supply: 9.25 V, 7 %, by the INA219 at 0x41 on BUS. Charge the battery."),
    ("0000", "ok  supply: 0.00 V, by the INA219 at 0x41 on BUS.")])
def test_the_supply_that_a_chip_beside_the_board_measures(folder, word, line):
    power_on(folder)
    chip_file(folder, 0x41).write_bytes(bytes.fromhex(f"399F 0000 {word} 0000 0000 0000"))
    assert lines(f"fake:{folder}")[-2] == line.replace("BUS", f"fake:{folder}")
    assert lines(f"fake:{folder}")[-1].startswith("ok  robot: could drive.")


@pytest.mark.parametrize("alarm, line", [
    ("0", "ok  supply: no undervoltage, by the rpi_volt of this computer."),
    ("1", "NOT supply: undervoltage, by the rpi_volt of this computer. "
          "Use a supply of 5 V and 3 A, and a short cable.")])
def test_the_supply_that_the_computer_measures(tmp_path, monkeypatch, alarm, line):
    (tmp_path / "name").write_text("rpi_volt\n")
    (tmp_path / "in0_lcrit_alarm").write_text(alarm)
    read = partial(supply.read_alarm, tmp_path / "in0_lcrit_alarm")
    monkeypatch.setattr(supply, "on_computer", lambda sysfs: [supply.Supply("rpi_volt of this computer", read)])
    assert lines(port="/dev/nowhere")[-2] == line


def test_a_bus_without_a_board(folder):
    folder.mkdir()
    assert lines(f"fake:{folder}")[2:-2] == [f"NOT 0x60 on fake:{folder}: no answer from 0x60 on fake:{folder}. "
                                             f"To plug it in: python3 -m jetbot.fake {folder}"]


def test_a_bus_that_cannot_be():
    assert lines("banana")[2] == ("NOT bus banana: an I2C bus cannot be 'banana'. "
                                  "Give a number (1 for /dev/i2c-1), fake, or fake:FOLDER.")


def test_every_bus_is_checked_and_first_the_one_of_this_computers_robot(monkeypatch):
    checked = []
    monkeypatch.setattr(host, "model", lambda: "NVIDIA Jetson Orin Nano Developer Kit")
    monkeypatch.setattr(host, "buses", lambda: [0, 1, 7, 10])
    monkeypatch.setattr(doctor, "check_bus", lambda bus, *address, **options: checked.append(bus) or [])
    lines()
    assert checked == [7, 0, 1, 10]


def test_a_port_that_is_named_is_checked_alone(monkeypatch):
    monkeypatch.setattr(host, "buses", lambda: [1])
    monkeypatch.setattr(doctor, "check_bus", pytest.fail)
    assert lines(port="/dev/nothing")[-2].startswith("NOT /dev/nothing: there is no serial port")


@pytest.mark.parametrize("address, chip, boards, command", [
    (0x61, PCA9685, "jetbot or adafruit or waveshare", "i2c_address:=0x61"),
    (0x6F, PCA9685, "jetbot or adafruit or waveshare", "i2c_address:=0x6f"),
    (0x58, SCMD, "sparkfun", "board:=sparkfun i2c_address:=0x58"),
    (0x63, SCMD, "sparkfun", "board:=sparkfun i2c_address:=0x63"),
    (0x60, SCMD, "sparkfun", "board:=sparkfun i2c_address:=0x60")])
def test_a_board_at_an_address_that_its_jumpers_select(plug_in, address, chip, boards, command):
    plug_in({address: chip})
    output = lines(1)
    assert output[-2].startswith(f"ok  0x{address:02x} on /dev/i2c-1: answers, and can be a board {boards}.")
    assert output[-1] == f"ok  robot: could drive. Start it with: {LAUNCH} {command}"


@pytest.mark.parametrize("address, command", [
    (0x40, "board:=waveshare_hat"), (0x41, "board:=waveshare_hat i2c_address:=0x41")])
def test_what_may_be_a_servo_board_is_offered_on_one_condition(plug_in, address, command):
    plug_in({address: PCA9685})
    *_, chip, robot = doctor.run_checks(1)
    assert str(chip).endswith(" A servo board answers in the same way: do not drive that.")
    condition = f"the chip at 0x{address:02x} is Waveshare's Motor Driver HAT and no servo board"
    assert str(robot) == f"NOT robot: could drive if {condition}. Start it with: {LAUNCH} {command}"
    assert robot.condition == chip.condition == condition
    assert lines(1, address=address)[-1] == str(robot)
    assert lines(1, board="waveshare_hat")[-1] == f"ok  robot: could drive. Start it with: {LAUNCH} {command}"


def test_a_board_that_is_certain_comes_before_one_that_may_be_a_servo_board(plug_in):
    plug_in({0x40: PCA9685, 0x5D: SCMD})
    assert lines(1)[-1] == f"ok  robot: could drive. Start it with: {LAUNCH} board:=sparkfun"


@pytest.mark.parametrize("board, address, command", [
    ("adafruit", 0x60, "board:=adafruit"), ("waveshare", 0x61, "board:=waveshare i2c_address:=0x61"),
    ("sparkfun", 0x58, "board:=sparkfun i2c_address:=0x58")])
def test_a_board_that_is_named_is_looked_for_alone(plug_in, board, address, command):
    plug_in({0x40: PCA9685, 0x5D: {}, address: SCMD if board == "sparkfun" else PCA9685})
    output = lines(1, board=board)
    assert not [line for line in output if "0x40 on" in line]
    assert output[-1] == f"ok  robot: could drive. Start it with: {LAUNCH} {command}"


@pytest.mark.parametrize("board, port", [("jetbot", None), ("jetbot", "/dev/nowhere"), ("jetbot_pro", None)])
def test_a_board_that_is_named_is_looked_for_where_it_can_be(plug_in, monkeypatch, board, port):
    plug_in({0x40: PCA9685, 0x5D: SCMD})
    monkeypatch.setattr(host, "buses", lambda: [1])
    output = "\n".join(lines(port=port, board=board))
    assert ("0x60 on /dev/i2c-1" in output, "/dev/nowhere" in output) == (board == "jetbot", board == "jetbot_pro")
    assert "NOT robot: no motor board found." in output


@pytest.mark.parametrize("chips", [{0x68: {}}, {0x61: {}, 0x41: {0x00: 0x39, 0x01: 0x9F}}, {0x40: {}}])
def test_another_chip_is_no_motor_board(plug_in, chips):
    plug_in(chips)
    assert lines(1)[-1].startswith("NOT robot: no motor board found.")


@pytest.mark.parametrize("configuration, name", [((0x39, 0x9F), "INA219"), ((0x71, 0x27), "INA3221")])
def test_a_power_monitor_at_the_address_of_waveshares_hat(plug_in, configuration, name):
    plug_in({0x40: dict(enumerate(configuration))})
    assert f"NOT 0x40 on /dev/i2c-1: the chip that answers is an {name}, which measures the supply." in lines(1)


def test_a_multiplexer_which_a_read_would_switch_is_left_alone(plug_in):
    bus = plug_in({})
    lines(1)
    assert (min(bus.read), max(bus.read)) == (0x40, 0x6F)


def test_other_addresses_are_read_on_the_robots_bus_alone(plug_in, monkeypatch):
    monkeypatch.setattr(host, "model", lambda: "NVIDIA Jetson Nano Developer Kit")
    monkeypatch.setattr(host, "buses", lambda: [0])
    bus = plug_in({})
    lines()
    assert set(bus.read) == {0x40, 0x5D, 0x60}
    monkeypatch.setattr(host, "buses", lambda: [1])
    lines()
    assert set(range(0x40, 0x70)) == set(bus.read)


def test_an_address_that_is_typed_is_the_only_one(plug_in):
    bus = plug_in({0x60: PCA9685, 0x61: PCA9685})
    assert lines(1, address=0x61)[-1].endswith(f"{LAUNCH} i2c_address:=0x61")
    assert 0x60 not in bus.read
    assert lines(1, address=0x62)[2].startswith("NOT 0x62 on /dev/i2c-1: no answer from 0x62 on /dev/i2c-1.")


def test_a_bus_that_is_stuck_is_not_read_at_every_address(plug_in):
    bus = plug_in({"any": errno.ETIMEDOUT})
    assert lines(1)[2].startswith("NOT 0x60 on /dev/i2c-1: the bus /dev/i2c-1 is stuck.")
    assert len(bus.read) <= 3


@pytest.mark.parametrize("driver, reported", [("ina3221", False), ("pca9685-pwm", True)])
def test_a_chip_that_a_kernel_driver_holds(plug_in, monkeypatch, driver, reported):
    monkeypatch.setattr(i2c, "kernel_driver", lambda device: driver)
    plug_in({0x40: errno.EBUSY})
    output = lines(1)
    assert output[2].startswith("NOT 0x60 on /dev/i2c-1: no answer from 0x60")
    held = f"NOT 0x40 on /dev/i2c-1: 0x40 on /dev/i2c-1 is in use by the kernel driver {driver}."
    assert any(line.startswith(held) for line in output) == reported
    assert lines(1, address=0x40)[2].startswith(held)


@pytest.mark.parametrize("model, chip, reported", [
    ("Raspberry Pi 4 Model B Rev 1.4", SCMD, True), ("Raspberry Pi 4 Model B Rev 1.4", {}, True),
    ("Raspberry Pi 5 Model B Rev 1.0", SCMD, False), ("NVIDIA Jetson Nano Developer Kit", SCMD, False)])
def test_a_computer_that_mishandles_the_clock_of_sparkfuns_board(plug_in, monkeypatch, model, chip, reported):
    monkeypatch.setattr(host, "model", lambda: model)
    plug_in({0x5D: chip})
    line = next(line for line in lines(1) if "0x5d on /dev/i2c-1" in line)
    assert ("dtoverlay=i2c-gpio,bus=3" in line) == reported


def test_another_chip_at_sparkfuns_address(folder):
    power_on(folder)
    chip_file(folder, 0x5D).write_bytes(bytes(256))
    assert str(probe.check_chip(f"fake:{folder}", 0x5D)) == (
        f"NOT 0x5d on fake:{folder}: the chip that answers is not a SparkFun motor driver.")


@pytest.mark.parametrize("module, noetic, advice", [
    ("rospy", False, "Install it with: sudo apt install python3-rospy"),
    ("diagnostic_updater", False, "Install it with: sudo apt install python3-diagnostic-updater"),
    ("smbus2", True, "Install it with: pip3 install smbus2"),
    ("serial", True, "Install it with: sudo apt install python3-serial"),
    ("rospy", True, "Type: source {}/setup.bash   Or install it with: sudo apt install ros-noetic-rospy")])
def test_install_advice(module, noetic, advice, tmp_path):
    assert doctor.install_advice(module, tmp_path if noetic else tmp_path / "none") == advice.format(tmp_path)


def test_only_packages_that_every_robot_needs_keep_it_from_driving(folder, monkeypatch):
    monkeypatch.setattr(doctor, "MODULES", ["no_such_module"])
    output = lines(f"fake:{folder}")
    assert output[0] == "NOT no_such_module: not installed. Install it with: sudo apt install python3-no-such-module"
    assert output[-1] == "NOT robot: cannot drive as long as no_such_module is not ok."
    monkeypatch.setattr(doctor, "NEEDED_BY_SOME", ["no_such_module"])
    assert lines(f"fake:{folder}")[-1].startswith("ok  robot: could drive.")


@pytest.mark.parametrize("text, line, last", [
    ("board: waveshare\ni2c_bus: BUS", "ok  FILE: names the board waveshare, and 0x60 on BUS answers. jetbot drives "
     "both layouts; Waveshare's boards from before August 2020 have Adafruit's.",
     "ok  robot: could drive. Start it with: roslaunch jetbot_control_node jetbot_controller.launch"),
    ("board: jetbot_pro\nport: /dev/nowhere", "NOT FILE: names the board jetbot_pro, but there is no serial port "
     "/dev/nowhere. Connect that board; or remove the file, and calibrate again.",
     "NOT robot: cannot drive as long as FILE is not ok."),
    ("speed: 3", "NOT FILE: there is no parameter speed. Fix it, or remove it.",
     "NOT robot: cannot drive as long as FILE is not ok.")])
def test_the_file_of_parameters(folder, tmp_path, text, line, last):
    file, bus = tmp_path / "jetbot.yaml", f"fake:{folder}"
    file.write_text(text.replace("BUS", bus))
    output = lines()
    assert line.replace("FILE", str(file)).replace("BUS", bus) in output
    assert output[-1] == last.replace("FILE", str(file))


@pytest.mark.parametrize("board, address, finding", [
    ("waveshare", "0x61", "names the board waveshare, and 0x61 on /dev/i2c-1 answers"),
    ("sparkfun", "0x61", "names the board sparkfun, but the chip that answers is not a SparkFun motor driver"),
    ("waveshare", "0x5e", "names the board waveshare, but the chip that answers is not a PCA9685"),
    ("waveshare", "0x62", "names the board waveshare, but no answer from 0x62 on /dev/i2c-1")])
def test_the_files_board_must_be_at_the_files_address(tmp_path, plug_in, board, address, finding):
    plug_in({0x60: PCA9685, 0x61: PCA9685, 0x5E: SCMD})
    (tmp_path / "jetbot.yaml").write_text(f"board: {board}\ni2c_address: {address}")
    assert f"{tmp_path}/jetbot.yaml: {finding}." in lines()[2]


@pytest.mark.parametrize("bus, port", [("fake", None), (None, "fake")])
def test_a_fake_robot_does_not_use_the_real_ones_file(tmp_path, bus, port):
    (tmp_path / "jetbot.yaml").write_text("speed: 3")
    assert lines(bus, port)[-1].startswith("ok  robot: could drive.")


def test_who_else_has_a_device_open(tmp_path):
    device = tmp_path / "i2c-1"
    device.touch()
    assert probe.check_users(str(tmp_path / "none")) == []
    with device.open() as file:
        assert str(probe.check_users(str(device))[0]).startswith(f"ok  {device}: no other program")
        other = subprocess.Popen(["sleep", "60"], stdin=file)
    checks = probe.check_users(str(device))
    other.kill()
    other.wait()
    assert [str(check) for check in checks] == [
        f"NOT {device}: also open in sleep ({other.pid}). Two programs on one motor board disturb each other: "
        "end one of them."]


@pytest.mark.parametrize("cgroup, cmdline", [
    ("0::/system.slice/jetbot_stats.service", "python3"), ("0::/docker/1", "python3 -m jetbot.apps.stats"),
    ("0::/user.slice", "/usr/bin/python3 /home/jetbot/jetbot/jetbot/apps/stats.py")])
def test_the_service_of_the_jetbots_display_may_have_the_bus_open(tmp_path, monkeypatch, cgroup, cmdline):
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    device = tmp_path / "i2c-1"
    device.touch()
    proc = tmp_path / "proc"
    add_process(proc / "7", device, cgroup, cmdline)
    assert [str(check) for check in probe.check_users(str(device), proc)] == [
        f"ok  {device}: no other program has it open but the service of the JetBot's display, which is normal."]
    add_process(proc / "8", device, "0::/user.slice", "python3 drive.py")
    assert [str(check) for check in probe.check_users(str(device), proc)] == [
        f"NOT {device}: also open in drive.py (8). Two programs on one motor board disturb each other: "
        "end one of them."]


def add_process(folder, device, cgroup, cmdline):
    """Make a process's folder in a fake /proc. cmdline: words without spaces."""
    (folder / "fd").mkdir(parents=True)
    (folder / "fd/3").symlink_to(device)
    (folder / "cgroup").write_text(cgroup + "\n")
    (folder / "cmdline").write_text(cmdline.replace(" ", "\0") + "\0")


def test_a_jetbot_pro_that_reports(folder):
    assert lines(port=f"fake:{folder}")[2:] == [
        f"ok  fake:{folder}: a JetBot Pro reports.",
        "ok  robot: could drive. Start it with: roslaunch jetbot_control_node jetbot_controller.launch "
        f"board:=jetbot_pro port:=fake:{folder}"]


def test_a_serial_port_with_something_else(folder, monkeypatch):
    monkeypatch.setattr(probe, "TELEMETRY_TIMEOUT", 0.1)
    monkeypatch.setattr(SerialLink, "read", lambda link: b"login: ")
    assert lines(port=f"fake:{folder}")[2] == (
        f"NOT fake:{folder}: opens, but no JetBot Pro reports. Is it this port, and is the robot switched on?")


@pytest.mark.parametrize("plugged, code", [(True, 0), (False, 1)])
def test_json_and_exit_code(folder, plugged, code, monkeypatch, capsys):
    power_on(folder)
    for file in [] if plugged else list(folder.iterdir()):
        file.unlink()
    before = {file: file.read_bytes() for file in folder.iterdir()}
    monkeypatch.setenv("JETBOT_I2C_BUS", f"fake:{folder}")
    monkeypatch.setattr(sys, "argv", ["doctor.py", "--json"])
    assert runpy.run_path(str(SOURCE / "scripts/doctor.py"))["main"]() == code
    robot = json.loads(capsys.readouterr().out)[-1]
    assert (robot["name"], robot["ok"]) == ("robot", plugged)
    assert {file: file.read_bytes() for file in folder.iterdir()} == before, "it only reads"


def test_a_reader_that_ends_early_ends_it_without_a_traceback(folder):
    power_on(folder)
    reader, output = os.pipe()
    os.close(reader)
    environment = {**os.environ, "PYTHONPATH": str(SOURCE / "src")}
    ended = subprocess.run([sys.executable, str(SOURCE / "scripts/doctor.py"), f"--i2c-bus=fake:{folder}"],
                           stdout=output, stderr=subprocess.PIPE, env=environment, check=False)
    os.close(output)
    assert ended.stderr == b"" and ended.returncode == -signal.SIGPIPE
