"""What the chip is sent, as bytes."""

import pytest

from conftest import registers
from jetbot.boards.pca9685 import PCA9685
from jetbot.fake.bus import power_on
from jetbot.i2c import I2CDevice


@pytest.fixture
def chip(folder, wire):
    chip = PCA9685(I2CDevice(f"fake:{folder}", 0x60), 1526, [range(8, 14), range(0, 4)])
    chip.start()
    wire.bits.clear()
    wire.states.clear()
    return chip


def output(folder, number):
    return registers(folder)[0x06 + 4 * number:][:4].hex(" ")


def test_a_chip_in_any_state_is_set_up(folder):
    power_on(folder)
    (folder / "0x60").write_bytes(bytes([0xA0, 0x14]) + bytes([0, 0x10, 0, 0]) * 63 + bytes(2))
    PCA9685(I2CDevice(f"fake:{folder}", 0x60), 1526, [range(4)]).start()
    state = registers(folder)
    assert (state[0x00], state[0x01], state[0xFE]) == (0x20, 0x04, 3)
    assert state[0x06:0x46] == bytes([0, 0, 0, 0x10]) * 4 + bytes([0, 0x10, 0, 0]) * 12


def test_outputs_are_off_before_the_chip_sleeps_and_wakes(folder, wire):
    spans = [range(8), range(8, 16)]
    PCA9685(I2CDevice(f"fake:{folder}", 0x60), 1526, spans).set_outputs(dict.fromkeys(range(16), 4096))
    wire.states.clear()
    PCA9685(I2CDevice(f"fake:{folder}", 0x60), 50, spans).start()
    off = [state[0x09:0x46:4] == bytes([0x10] * 16) for state in wire.states]
    assert not any(state[0x00] & 0x10 for state in wire.states[:off.index(True)])
    assert all(off[off.index(True):])
    assert wire.states[-1][0xFE] == 121


@pytest.mark.parametrize("duty, wanted", [
    (0, "00 00 00 10"), (1, "00 00 01 00"), (2048, "00 00 00 08"), (4095, "00 00 ff 0f"), (4096, "00 10 00 00")])
def test_duty_in_registers(chip, folder, duty, wanted):
    chip.set_outputs({9: 1234})
    chip.set_outputs({9: duty})
    assert output(folder, 9) == wanted


@pytest.mark.parametrize("changes, counts", [
    ({}, (0, 0)), ({0x00: 0x11, 0x01: 0x04, 0xFE: 0x1E}, (1, 0)), ({0xFE: 0x1E}, (1, 0)), ({0xFE: 0x79}, (0, 1)),
    ({0x00: 0x00}, (0, 1)), ({0x29: 0x10}, (0, 1))])
def test_counts_brown_outs_and_the_writes_of_other_programs(chip, folder, changes, counts):
    chip.set_outputs({8: 100})
    state = bytearray(registers(folder))
    for register, value in changes.items():
        state[register] = value
    (folder / "0x60").write_bytes(state)
    for _ in range(8):
        chip.verify()
        chip.set_outputs({8: 100})
    assert (chip.resets, chip.overwritten) == counts
