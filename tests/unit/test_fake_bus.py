"""The fake bus is honest: it does what the chip's data sheet says, also to a driver that is wrong."""

import pytest

from conftest import registers
from jetbot.fake.bus import FakeBus, power_on
from jetbot.fake.chips import PCA9685


@pytest.fixture
def bus(folder):
    return FakeBus(folder)


def test_power_on_values(bus, folder):
    assert registers(folder)[:2].hex() == "1104"
    assert registers(folder)[0x06:0x46] == bytes([0, 0, 0, 0x10]) * 16
    assert registers(folder)[0xFE] == 0x1E


def test_without_auto_increment_all_bytes_land_in_one_register(bus, folder):
    bus.write_i2c_block_data(0x60, 0x06, [1, 2, 3])
    assert registers(folder)[0x06:0x09].hex() == "030000"


def test_with_auto_increment_a_block_fills_registers(bus, folder):
    bus.write_byte_data(0x60, 0x00, 0x30)
    bus.write_i2c_block_data(0x60, 0x06, [1, 2, 3])
    assert registers(folder)[0x06:0x09].hex() == "010203"


def test_pre_scale_is_written_only_asleep(bus):
    bus.write_byte_data(0x60, 0x00, 0x00)
    bus.write_byte_data(0x60, 0xFE, 3)
    assert bus.read_byte_data(0x60, 0xFE) == 0x1E
    bus.write_byte_data(0x60, 0x00, 0x10)
    bus.write_byte_data(0x60, 0xFE, 3)
    assert bus.read_byte_data(0x60, 0xFE) == 3


def test_no_output_while_asleep(bus, folder):
    bus.write_byte_data(0x60, 0x00, 0x30)
    bus.write_i2c_block_data(0x60, 0x06, [0, 0x10, 0, 0])
    assert PCA9685.duty(registers(folder), 0) == 0
    bus.write_byte_data(0x60, 0x00, 0x20)
    assert PCA9685.duty(registers(folder), 0) == 1


def test_all_outputs_at_once(bus, folder):
    bus.write_byte_data(0x60, 0xFD, 0x07)
    assert registers(folder)[0x09:0x46:4] == bytes([0x07] * 16)


def test_an_unplugged_chip_does_not_answer(bus, folder):
    (folder / "0x60").unlink()
    with pytest.raises(OSError) as error:
        bus.read_byte_data(0x60, 0)
    assert error.value.errno == 121


def test_transfers_fail_on_request(bus, folder):
    (folder / "0x60.fail").write_text("2\n")
    for _ in range(2):
        with pytest.raises(OSError):
            bus.read_byte_data(0x60, 0)
    assert bus.read_byte_data(0x60, 0) == 0x11


def test_a_brown_out_forgets_everything(bus, folder):
    bus.write_byte_data(0x60, 0x00, 0x20)
    power_on(folder)
    assert bus.read_byte_data(0x60, 0x00) == 0x11


def test_another_process_meets_the_same_chip(bus, folder):
    bus.write_byte_data(0x60, 0x00, 0x20)
    assert FakeBus(folder).read_byte_data(0x60, 0x00) == 0x20
