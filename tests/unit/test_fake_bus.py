"""The fake hardware follows the chip's data sheet, also for a driver that is wrong."""

import runpy
import sys

import pytest

from conftest import registers
from jetbot.fake.bus import FakeBus, power_on
from jetbot.fake.chips import PCA9685
from jetbot.fake.motors import wheel_speeds

FULL, HALF, OFF = bytes([0, 0x10, 0, 0]), bytes([0, 0, 0, 0x08]), bytes([0, 0, 0, 0x10])  # one output's registers


@pytest.fixture
def bus(folder):
    return FakeBus(folder)


def test_power_on_values(bus, folder):
    bus.write_byte_data(0x60, 0x00, 0x20)
    power_on(folder)
    assert registers(folder)[:2].hex() == "1104"
    assert registers(folder)[0x06:0x46] == OFF * 16
    assert registers(folder)[0xFE] == 0x1E


@pytest.mark.parametrize("mode1, outputs", [(0x10, "030000"), (0x30, "010203")])
def test_a_block_fills_registers_only_with_auto_increment(bus, folder, mode1, outputs):
    bus.write_byte_data(0x60, 0x00, mode1)
    bus.write_i2c_block_data(0x60, 0x06, [1, 2, 3])
    assert registers(folder)[0x06:0x09].hex() == outputs


@pytest.mark.parametrize("mode1, pre_scale", [(0x00, 0x1E), (0x10, 3)])
def test_pre_scale_is_written_only_asleep(bus, mode1, pre_scale):
    bus.write_byte_data(0x60, 0x00, mode1)
    bus.write_byte_data(0x60, 0xFE, 3)
    assert bus.read_byte_data(0x60, 0xFE) == pre_scale


def test_no_output_while_asleep(bus, folder):
    bus.write_byte_data(0x60, 0x00, 0x30)
    bus.write_i2c_block_data(0x60, 0x06, [0, 0x10, 0, 0])
    assert PCA9685.duty(registers(folder), 0) == 0
    bus.write_byte_data(0x60, 0x00, 0x20)
    assert PCA9685.duty(registers(folder), 0) == 1


def test_all_outputs_at_once(bus, folder):
    bus.write_byte_data(0x60, 0xFD, 0x07)
    assert registers(folder)[0x09:0x46:4] == bytes([0x07] * 16)


@pytest.mark.parametrize("backward, forward, speed", [
    (OFF, HALF, 0.5), (HALF, OFF, -0.5), (OFF, OFF, 0.0), (FULL, FULL, 0.0), (HALF, FULL, 0.0), (FULL, HALF, 0.0)])
def test_a_motor_with_both_inputs_high_gets_no_power(bus, folder, backward, forward, speed):
    bus.write_byte_data(0x60, 0x00, 0x20)
    bus.write_i2c_block_data(0x60, 0x06, list(backward + forward))
    assert wheel_speeds(folder, "waveshare") == (speed, 0.0)


@pytest.mark.parametrize("name", ["/dev/null", "/dev/null/\x1b[2J"])
def test_a_folder_that_cannot_be_made_gets_one_sentence(monkeypatch, name):
    monkeypatch.setattr(sys, "argv", ["jetbot.fake", name])
    with pytest.raises(SystemExit) as end:
        runpy.run_module("jetbot.fake", run_name="__main__")
    assert end.value.code.startswith("The fake bus /dev/null") and end.value.code.isprintable()
