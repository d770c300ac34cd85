"""SparkFun's motor driver: its bytes, its failsafe, and what it does when something is wrong."""

import os
import time
from unittest.mock import Mock

import pytest

from conftest import registers
from jetbot import BusError
from jetbot.boards import Options, open_board
from jetbot.fake.bus import FakeBus, power_on
from jetbot.fake.motors import wheel_speeds
from jetbot.i2c import I2CDevice


@pytest.fixture
def board(folder):
    return open_board("sparkfun", Options(f"fake:{folder}", failsafe=1.0))


@pytest.mark.parametrize("left, right, drive", [
    (0, 0, "8080"), (1, 1, "0000"), (-1, -1, "ffff"), (0.5, -0.5, "40c0"), (0.001, -0.001, "8080"),
    (-0.999, 1, "ff00")])
def test_drive_bytes(board, folder, left, right, drive):
    board.drive(left, right)
    assert registers(folder, 0x5D)[0x20:0x22].hex() == drive


def test_wheels_turn(board, folder):
    board.drive(0.5, -0.25)
    assert wheel_speeds(folder, "sparkfun") == (0.5, -0.25)


def test_both_wheels_in_one_transfer_and_none_for_a_repeated_command(folder, wire):
    board = open_board("sparkfun", Options(f"fake:{folder}"))
    wire.bits.clear()
    board.drive(0.5, 0.25)
    board.drive(0.5, 0.25)
    assert wire.bits == [2 + 9 * 4]


def test_wheel_by_wheel_where_the_chip_takes_no_blocks(folder, monkeypatch):
    from jetbot.fake.chips import SCMD
    write = SCMD.write
    monkeypatch.setattr(SCMD, "write", lambda registers, register, data: write(registers, register, data[:1]))
    open_board("sparkfun", Options(f"fake:{folder}")).drive(0.5, -0.25)
    assert wheel_speeds(folder, "sparkfun") == (0.5, -0.25)


def test_a_chip_that_refuses_blocks(folder, monkeypatch):
    def write(bus, address, register, data):
        raise OSError(121, "Remote I/O error")

    write_block = FakeBus.write_i2c_block_data
    monkeypatch.setattr(FakeBus, "write_byte_data", lambda bus, *args: write_block(bus, *args[:2], [args[2]]))
    monkeypatch.setattr(FakeBus, "write_i2c_block_data", write)
    open_board("sparkfun", Options(f"fake:{folder}")).drive(0.5, -0.25)
    assert wheel_speeds(folder, "sparkfun") == (0.5, -0.25)


def test_a_chip_that_is_not_ready_holds_up_no_program_that_drives(board, folder, monkeypatch):
    monkeypatch.setattr("jetbot.boards.scmd.START_UP", 9)
    board.drive(0.5, 0.5)
    power_on(folder)
    registers = bytearray((folder / "0x5d").read_bytes())
    registers[0x77] = 0
    (folder / "0x5d").write_bytes(registers)
    start = time.monotonic()
    with pytest.raises(BusError, match="^The motor driver on .* is not ready. Switch the robot off and on.$"):
        board.refresh(0.5, 0.5, idle=True)
    assert time.monotonic() - start < 1


@pytest.mark.parametrize("seconds, register", [(1.0, 100), (0.5, 50), (9.0, 255), (0.01, 10), (0, 0)])
def test_failsafe_time(folder, seconds, register):
    open_board("sparkfun", Options(f"fake:{folder}", failsafe=seconds))
    assert registers(folder, 0x5D)[0x76] == register
    assert registers(folder, 0x5D)[0x1F] & 1


def test_the_failsafe_stops_when_nothing_is_written(board, folder):
    board.drive(1, 1)
    os.utime(folder / "0x5d", (time.time() - 1.1, time.time() - 1.1))
    assert wheel_speeds(folder, "sparkfun") == (0, 0)
    board.refresh(1, 1, idle=True)
    assert wheel_speeds(folder, "sparkfun") == (1, 1)


def test_a_chip_that_lost_its_power_comes_back(board, folder):
    board.drive(0.5, 0.5)
    power_on(folder)
    board.refresh(0.5, 0.5, idle=True)
    assert wheel_speeds(folder, "sparkfun") == (0.5, 0.5)
    assert registers(folder, 0x5D)[0x76] == 100


def test_another_chip_at_the_address(folder, monkeypatch):
    power_on(folder)
    (folder / "0x5d").write_bytes(bytes(256))
    close = Mock()
    monkeypatch.setattr(I2CDevice, "close", close)
    with pytest.raises(BusError, match="^At 0x5d on fake:.* is no SparkFun motor driver. Something else answers there"):
        open_board("sparkfun", Options(f"fake:{folder}"))
    close.assert_called_once()
