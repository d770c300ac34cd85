"""The supply is read where a chip or the computer measures it, and only there. Registers are as in TI's data sheet."""

import errno
import math
import time
from unittest.mock import Mock

import pytest

from jetbot import JetbotError, i2c
from jetbot.fake.bus import power_on
from jetbot.i2c import I2CDevice
from jetbot.serial_link import SerialLink
from jetbot.supply import find_supply
from jetbot_control_node.supply import supply_watch
from jetbot_control_node.supply.supply_watch import SupplyWatch

PCA9685_WITHOUT_INCREMENT = bytes.fromhex("1111 0000 E2E2 0000 0000 0000")  # what it answers for registers 0 and 2


@pytest.fixture
def link(six_boards, folder):
    """The link to a motor board on a fake bus."""
    power_on(folder)
    return I2CDevice(f"fake:{folder}", 0x60)


@pytest.fixture
def sysfs(tmp_path):
    return tmp_path / "sys"


def put(sysfs, **files):
    """Write files of Linux's sensors, by what is the last part of their path."""
    folders = {"in_voltage0_input": "bus/i2c/drivers/ina3221x/6-0040/iio:device0"}
    for name, text in files.items():
        file = sysfs / folders.get(name, "class/hwmon/hwmon1") / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(text.encode(errors="surrogateescape"))


def on_computer(sysfs):
    """The supply of a robot with a serial board, as the computer reports it."""
    return find_supply(SerialLink("/dev/ttyACM0"), sysfs)


def set_bus_voltage(folder, word, address="0x41"):
    chip = (folder / "0x41").rename(folder / address)
    chip.write_bytes(chip.read_bytes()[:4] + bytes.fromhex(word) + chip.read_bytes()[6:])


@pytest.mark.parametrize("address, word, volts, percentage", [
    ("0x41", "6270", 12.6, 1.0), ("0x41", "5E88", 12.1, 0.861), ("0x41", "5E8B", 12.1, 0.861),
    ("0x41", "4650", 9.0, 0.0), ("0x41", "4E20", 10.0, 0.278), ("0x41", "3E80", 8.0, 0.0), ("0x41", "7530", 15.0, 1.0),
    ("0x41", "0000", 0.0, math.nan), ("0x41", "2710", 5.0, math.nan),
    ("0x42", "41A0", 8.4, 1.0), ("0x42", "3840", 7.2, 0.5), ("0x42", "2EE0", 6.0, 0.0), ("0x42", "5E88", 12.1, 0.861)])
def test_a_pack_has_three_cells_but_that_of_an_ups_module_two_unless_its_voltage_is_higher(
        link, folder, address, word, volts, percentage):
    set_bus_voltage(folder, word, address)
    reading = find_supply(link).read()
    assert reading.voltage == pytest.approx(volts)
    assert reading.percentage == pytest.approx(percentage, abs=0.001, nan_ok=True)
    assert str(reading).count("%") == (not math.isnan(percentage))


def test_a_reading_is_one_short_transfer_and_the_look_for_the_chip_two(link, wire):
    supply = find_supply(link)
    assert wire.bits == [2 + 9 * 5] * 2
    wire.bits.clear()
    assert str(supply.read()) == "12.10 V, 86 %"
    assert wire.bits == [2 + 9 * 5]


@pytest.mark.parametrize("registers", [
    PCA9685_WITHOUT_INCREMENT, bytes(12), b"\xff" * 12,
    bytes.fromhex("7127 0000 5E88 0000 0000 0000"),   # INA3221
    bytes.fromhex("4127 0000 2580 0000 0000 0000")])  # INA226
def test_another_chip_at_its_address_is_no_supply(link, folder, registers):
    (folder / "0x41").write_bytes(registers)
    assert find_supply(link) is None


def test_a_motor_board_at_its_address_is_not_asked(link, wire):
    assert find_supply(I2CDevice(link.name, 0x41)) is None
    assert wire.bits == []


def test_unplugged_it_fails_after_one_try_and_plugged_in_it_is_read_again(link, folder):
    supply = find_supply(link)
    chip = supply.read.args[0]
    (folder / "0x41").unlink()
    before = chip.errors
    with pytest.raises(JetbotError, match="No answer from 0x41"):
        supply.read()
    assert chip.errors == before + 1
    power_on(folder)
    assert supply.read().voltage == pytest.approx(12.1)


@pytest.mark.parametrize("transfer, problem", [
    (Mock(side_effect=OSError(errno.ETIMEDOUT, "")), "the bus /dev/i2c-1 is stuck"),
    (lambda: time.sleep(0.2) or [0x5E, 0x88], "the bus /dev/i2c-1 is too slow to stop the robot in time")])
def test_a_reading_that_holds_up_the_bus_is_the_last_one(monkeypatch, transfer, problem):
    answers = [lambda: [0x39, 0x9F], *[lambda: [0x5E, 0x88]] * 2, transfer, transfer]
    bus = Mock(read_i2c_block_data=lambda *_: answers.pop(0)())
    monkeypatch.setattr(i2c, "open_bus", lambda *_: bus)
    monkeypatch.setattr(supply_watch, "INTERVAL", 0.01)
    watch, readings = SupplyWatch(find_supply(I2CDevice(1, 0x60)), ""), []
    watch.run(readings.append, lambda: False)
    assert str(watch).startswith(f"unknown: {problem}")
    assert readings[0].voltage == 12.1 and math.isnan(readings[-1].voltage) and len(readings) <= 3


@pytest.mark.parametrize("files, reading", [
    ({"in_voltage0_input": "5064\n"}, "5.06 V, by the ina3221x of this computer"),  # a Nano's input, and no battery
    ({"name": "rpi_volt\n", "in0_lcrit_alarm": "1\n"}, "undervoltage, by the rpi_volt of this computer"),
    ({"name": "soctherm_oc\n", "oc1_event_cnt": "0\n"}, "no undervoltage, by the soctherm_oc of this computer"),
    ({"name": "nct6775\n", "in0_lcrit_alarm": "1\n"}, None),
    *(({"in_voltage0_input": text}, None) for text in ("", "five\n", "-5\n", "99999\n", "\udcff"))], ids=ascii)
def test_what_a_computer_reports_of_its_supply(sysfs, files, reading):
    put(sysfs, **files)
    supply = on_computer(sysfs)
    assert (supply and f"{supply.read()}, by the {supply.sensor}") == reading


@pytest.mark.parametrize("spoil, problem", [
    (lambda file: file.unlink(), "in_voltage0_input cannot be read: No such file or directory"),
    (lambda file: file.write_text("70000"), "The supply cannot have 70.0 V, as .*in_voltage0_input reports")])
def test_a_file_that_is_spoilt_later_is_one_sentence(sysfs, spoil, problem):
    put(sysfs, in_voltage0_input="5064\n")
    supply = on_computer(sysfs)
    spoil(next(sysfs.rglob("in_voltage0_input")))
    with pytest.raises(JetbotError, match=problem):
        supply.read()


def test_the_chip_comes_before_the_computer_and_fake_hardware_has_no_computer(link, folder, sysfs):
    put(sysfs, in_voltage0_input="5064\n")
    assert find_supply(link, sysfs).sensor == f"INA219 at 0x41 on fake:{folder}"
    (folder / "0x41").unlink()
    assert find_supply(link, sysfs) is None
    assert find_supply(SerialLink(f"fake:{folder}"), sysfs) is None
