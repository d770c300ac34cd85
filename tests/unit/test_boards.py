"""Each board's registers, against a table written from its circuit diagram."""

import itertools
from random import Random
from unittest.mock import Mock, call

import pytest

from conftest import registers
from jetbot import BusError, InvalidValue, i2c
from jetbot.boards import find_board
from jetbot.connection import open_board, stop_board
from jetbot.fake import chip_file
from jetbot.fake.bus import FakeBus, power_on
from jetbot.fake.motors import wheel_speeds

OFF, HIGH, HALF = "00000010", "00100000", "00000008"

ADAFRUIT = {  # output: its registers, for the left motor 8, 10, 9 (PWM, IN1, IN2) and the right one 13, 11, 12
    (0.5, 0.5): {8: HALF, 9: HIGH, 10: OFF, 11: OFF, 12: HIGH, 13: HALF},
    (-0.5, -0.5): {8: HALF, 9: OFF, 10: HIGH, 11: HIGH, 12: OFF, 13: HALF},
    (-1, 1): {8: HIGH, 9: OFF, 10: HIGH, 11: OFF, 12: HIGH, 13: HIGH},
    (0.5, 0): {8: HALF, 9: HIGH, 10: OFF, 11: OFF, 12: OFF, 13: OFF},
    (0, 0): {8: OFF, 9: OFF, 10: OFF, 11: OFF, 12: OFF, 13: OFF},
}
WAVESHARE = {  # left forward 1, backward 0; right forward 2, backward 3
    (0.5, 0.5): {0: OFF, 1: HALF, 2: HALF, 3: OFF},
    (-0.5, -0.5): {0: HALF, 1: OFF, 2: OFF, 3: HALF},
    (-1, 1): {0: HIGH, 1: OFF, 2: HIGH, 3: OFF},
    (0.5, 0): {0: OFF, 1: HALF, 2: OFF, 3: OFF},
    (0, 0): {0: OFF, 1: OFF, 2: OFF, 3: OFF},
}
JETBOT = {speeds: {**ADAFRUIT[speeds], **WAVESHARE[speeds]} for speeds in ADAFRUIT}
WAVESHARE_HAT = {  # left PWM 0, AIN1 1, AIN2 2; right PWM 5, BIN1 3, BIN2 4; forward: IN1 low, IN2 high
    (0.5, 0.5): {0: HALF, 1: OFF, 2: HIGH, 3: OFF, 4: HIGH, 5: HALF},
    (-0.5, -0.5): {0: HALF, 1: HIGH, 2: OFF, 3: HIGH, 4: OFF, 5: HALF},
    (-1, 1): {0: HIGH, 1: HIGH, 2: OFF, 3: OFF, 4: HIGH, 5: HIGH},
    (0.5, 0): {0: HALF, 1: OFF, 2: HIGH, 3: OFF, 4: OFF, 5: OFF},
    (0, 0): {0: OFF, 1: OFF, 2: OFF, 3: OFF, 4: OFF, 5: OFF},
}
TABLES = {"adafruit": (0x60, ADAFRUIT), "waveshare": (0x60, WAVESHARE), "jetbot": (0x60, JETBOT),
          "waveshare_hat": (0x40, WAVESHARE_HAT)}
CASES = [(name, address, speeds, outputs) for name, (address, table) in TABLES.items()
         for speeds, outputs in table.items()]
SPEEDS = (0, 0.5, 1, -0.3, -1)
PAIRS = list(itertools.product(SPEEDS, SPEEDS))


@pytest.mark.parametrize("name, address, speeds, outputs", CASES)
def test_registers(folder, name, address, speeds, outputs):
    board = open_board(find_board(name), f"fake:{folder}")
    for earlier in ((0.7, -0.2), (-0.7, 0.2), (1, 1), (0, 0)):
        board.drive(*earlier)
        board.drive(*speeds)
        for output in range(16):
            assert registers(folder, address)[0x06 + 4 * output:][:4].hex() == outputs.get(output, OFF)


@pytest.mark.parametrize("name", ["jetbot", "adafruit", "waveshare", "waveshare_hat"])
def test_never_both_directions_at_once_and_few_transfers(folder, wire, name):
    board = open_board(find_board(name), f"fake:{folder}")
    for before, after in itertools.product(PAIRS, PAIRS):
        board.drive(*before)
        wire.bits.clear()
        wire.states.clear()
        board.drive(*after)
        assert (len(wire.bits) <= 2 and sum(wire.bits) <= 400) or (len(wire.bits) <= 3 and sum(wire.bits) <= 160)
        for state in wire.states:
            high = {output for output in range(16) if not state[0x09 + 4 * output] & 0x10}
            directions = ((1, 2), (3, 4)) if name == "waveshare_hat" else ((9, 10), (12, 11), (1, 0), (2, 3))
            assert not any({forward, backward} <= high for forward, backward in directions)


def test_any_change_of_speed_ahead_takes_at_most_three_transfers_and_160_bits(folder, wire):
    board = open_board(find_board("jetbot"), f"fake:{folder}")
    random = Random(1)
    board.drive(0.5, 0.5)
    for _ in range(300):
        wire.bits.clear()
        step = random.choice((0.0005, 0.02, 0.9))
        board.drive(*(min(0.99, max(0.01, 0.5 + random.uniform(-step, step))) for _ in range(2)))
        assert len(wire.bits) <= 3
        assert sum(wire.bits) <= 160


@pytest.mark.parametrize("name, transfers", [
    ("jetbot", [2 + 9 * (3 + length) for length in (2, 1, 24, 16)]),  # MODE1 and MODE2, PRE_SCALE, two spans of outputs
    ("sparkfun", [2 + 9 * 4] * 5)])
def test_each_verification_is_one_transfer_and_successive_ones_read_all(folder, wire, name, transfers):
    board = open_board(find_board(name), f"fake:{folder}")
    wire.bits.clear()
    for _ in transfers:
        board.verify()
    assert sorted(wire.bits) == sorted(transfers)  # the first of them has been when the board was opened


@pytest.mark.parametrize("name, address, register, value", [
    *(("jetbot", 0x60, *change) for change in ((0x00, 0x11), (0x01, 0x14), (0xFE, 0x1E), (0x09, 0x00), (0x26, 0x55))),
    *(("sparkfun", 0x5D, *change) for change in ((0x70, 0), (0x1F, 0), (0x20, 0x80), (0x21, 0), (0x76, 50)))])
def test_a_changed_register_is_restored(folder, name, address, register, value):
    board = open_board(find_board(name), f"fake:{folder}")
    board.drive(0.5, 0.5)
    good = registers(folder, address)
    chip_file(folder, address).write_bytes(good[:register] + bytes([value]) + good[register + 1:])
    assert registers(folder, address) != good
    for _ in range(5):
        board.verify()
    board.drive(0.5, 0.5)
    assert registers(folder, address) == good


def test_another_chip_is_not_driven(folder, monkeypatch, six_boards):
    monkeypatch.delenv("MORBOT", raising=False)
    power_on(folder)
    row = find_board("waveshare", 0x41)._replace(chip="")  # as on a real bus, which does not know what is meant
    with pytest.raises(BusError) as error:
        open_board(row, f"fake:{folder}")
    assert str(error.value) == (
        f"The chip at 0x41 on fake:{folder} is not the motor board: it does not hold what it is sent. "
        "To find the board, run: rosrun jetbot_tools doctor.py")


def test_the_guard_stops_a_board_without_reading_it(folder, wire, monkeypatch):
    open_board(find_board("adafruit"), f"fake:{folder}").drive(1, 1)
    monkeypatch.setattr(wire, "read_i2c_block_data", None)
    stop_board(find_board("adafruit"), f"fake:{folder}")
    assert wheel_speeds(folder) == (0, 0)


def test_the_guards_stop_closes_the_bus(folder, monkeypatch):  # it may try again for ten minutes
    bus = Mock(wraps=FakeBus(folder))
    monkeypatch.setattr(i2c, "open_bus", lambda *_: bus)
    stop_board(find_board("adafruit"), f"fake:{folder}")
    assert bus.mock_calls[-1] == call.close()


def test_a_board_on_a_serial_port_has_no_address():
    assert find_board("jetbot_pro", 0x61) == find_board("jetbot_pro")


@pytest.mark.parametrize("address", [0, 0x78, "61h", True, 1.5])
def test_what_is_no_address_is_refused(address):
    with pytest.raises(InvalidValue, match="^The I2C address must be an address from 0x03 to 0x77, not "):
        find_board("adafruit", address)


def test_unknown_board():
    with pytest.raises(InvalidValue, match="^There is no board 'lego'. Choose one of: jetbot, .*jetbot_pro"):
        find_board("lego")
