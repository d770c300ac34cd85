"""SparkFun's motor driver: its bytes, its failsafe, and what it does when something is wrong."""

import os
import time
from unittest.mock import Mock

import pytest

from conftest import registers
from jetbot import BusError
from jetbot.boards import find_board
from jetbot.connection import open_board
from jetbot.errors import NotReady
from jetbot.fake.bus import FakeBus, power_on
from jetbot.fake.chips import SCMD
from jetbot.fake.motors import wheel_speeds
from jetbot.i2c import I2CDevice


@pytest.fixture
def board(folder):
    return open_board(find_board("sparkfun"), f"fake:{folder}")


@pytest.mark.parametrize("left, right, drive", [
    (0, 0, "8080"), (1, 1, "0000"), (-1, -1, "ffff"), (0.5, -0.5, "40c0"), (0.001, -0.001, "8080"),
    (-0.999, 1, "ff00")])
def test_drive_bytes_which_are_sent_one_by_one(folder, wire, left, right, drive):
    board = open_board(find_board("sparkfun"), f"fake:{folder}")
    board.drive(left, right)
    assert registers(folder, 0x5D)[0x20:0x22].hex() == drive
    assert max(wire.bits) == 2 + 9 * 4, "no transfer has more than the byte that it reads or writes"


@pytest.fixture
def not_ready(folder):
    """A chip that is just starting."""
    power_on(folder)
    chip = bytearray(registers(folder, 0x5D))
    chip[0x77] = 0
    (folder / "0x5d").write_bytes(chip)


def test_a_chip_that_is_not_ready_holds_up_no_program_that_drives(board, not_ready):
    for _ in range(5):  # as many registers as are read back in turn
        board.verify()
    with pytest.raises(NotReady, match="^The motor driver on .* is not ready. Switch the robot off and on.$"):
        board.drive(0.5, 0.5)


def test_opening_waits_until_the_chip_is_ready_but_not_for_ever(not_ready, folder, monkeypatch):
    with monkeypatch.context() as patch, pytest.raises(NotReady):
        patch.setattr("jetbot.connection.READY_TIMEOUT", 0.05)
        open_board(find_board("sparkfun"), f"fake:{folder}")
    monkeypatch.setattr("jetbot.wait.time.sleep", lambda _: (folder / "0x5d").write_bytes(SCMD.POWER_ON))
    open_board(find_board("sparkfun"), f"fake:{folder}").drive(0.5, 0.5)
    assert wheel_speeds(folder, "sparkfun") == (0.5, 0.5)


def test_the_timer_is_off_until_it_is_fed_and_then_stops_the_motors_unless_it_is_fed(board, folder):
    board.drive(1, 1)
    assert registers(folder, 0x5D)[0x76] == 0
    board.keep_alive()
    assert registers(folder, 0x5D)[0x76] == 100
    os.utime(folder / "0x5d", (time.time() - 1.1, time.time() - 1.1))
    assert wheel_speeds(folder, "sparkfun") == (0, 0)
    FakeBus(folder).write_i2c_block_data(0x5D, 0x20, [0x80, 0x00])  # which the feeding repairs
    board.keep_alive()
    assert wheel_speeds(folder, "sparkfun") == (1, 1)


@pytest.mark.parametrize("another, changes, counts", [
    (False, {}, (0, 0)), (True, {}, (0, 1)), (False, {0x76: 0}, (0, 1)), (False, {0x1F: 0}, (0, 1)),
    (False, {0x21: 0x00}, (0, 1)), (False, dict(enumerate(SCMD.POWER_ON)), (1, 0))])
def test_a_brown_out_and_another_program_are_repaired_and_counted(board, folder, another, changes, counts):
    board.keep_alive()
    board.drive(0.5, 0.5)
    good = registers(folder, 0x5D)
    if another:
        open_board(find_board("sparkfun"), f"fake:{folder}")
    state = bytearray(registers(folder, 0x5D))
    for register, value in changes.items():
        state[register] = value
    (folder / "0x5d").write_bytes(state)
    for _ in range(5):
        board.verify()
        board.drive(0.5, 0.5)
    board.keep_alive()
    assert registers(folder, 0x5D) == good
    assert (board.resets, board.overwritten) == counts


def test_feeding_the_timer_after_a_brown_out_sets_the_board_up_again(board, folder):
    board.keep_alive()
    board.drive(0.5, 0.5)
    power_on(folder)
    board.keep_alive()
    board.drive(0.5, 0.5)
    assert wheel_speeds(folder, "sparkfun") == (0.5, 0.5)
    assert (board.resets, board.overwritten) == (1, 0)


def test_another_chip_at_the_address(folder, monkeypatch):
    power_on(folder)
    (folder / "0x5d").write_bytes(bytes(256))
    close = Mock()
    monkeypatch.setattr(I2CDevice, "close", close)
    with pytest.raises(BusError, match="^The chip at 0x5d on fake:.* is not a SparkFun motor driver. Choose another"):
        open_board(find_board("sparkfun"), f"fake:{folder}")
    close.assert_called_once()
