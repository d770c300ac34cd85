"""A servo on an output of its own keeps its pulse, whatever happens to the motors on the same chip."""

import contextlib

import pytest
from shared_chip import SharedPCA9685

from jetbot import BusError, i2c
from jetbot.boards import find_board
from jetbot.connection import open_board
from jetbot.guard.process import try_to_stop

BUS, SERVO = "/dev/i2c-1", 15
OUTPUTS = {"jetbot": (8, 9, 10, 13, 12, 11, 1, 0, 2, 3), "adafruit": (8, 9, 10, 13, 12, 11), "waveshare": (1, 0, 2, 3),
           "waveshare_hat": (0, 1, 2, 5, 3, 4)}
PULSE = (1503, 50)  # us high, Hz
STATES = [(mode1, mode2) for mode1 in (0x00, 0x01, 0x20, 0x21, 0x10, 0x31) for mode2 in (0x00, 0x04, 0x0C, 0x14, 0x1C)]
each_board = pytest.mark.parametrize("board", OUTPUTS)


@pytest.fixture
def chip(monkeypatch):
    """A chip at 50 Hz, as a servo's program sets it up, whose servo's output is watched."""
    chip = SharedPCA9685(SERVO)
    for register, value in (0x00, 0x10), (0xFE, 121), (0x00, 0x20), (0x01, 0x04):
        chip.write_byte_data(0x60, register, value)
    chip.write_i2c_block_data(0x60, 6 + 4 * SERVO, [0, 0, 0x34, 0x01])
    monkeypatch.setattr(i2c, "open_bus", lambda *_: chip)
    monkeypatch.setattr(i2c, "bus_advice", lambda: "")
    assert chip.pulse(SERVO) == PULSE
    chip.seen.clear()
    return chip


def is_driving(chip, board):
    return any(chip.high(output) for output in OUTPUTS[board])


def start(board, pwm_frequency=50):
    """Return the driver of a board, driving."""
    driver = open_board(find_board(board), BUS, pwm_frequency)
    driver.drive(0.5, -0.3)
    return driver


@each_board
def test_through_start_and_end(chip, make_robot, board):
    with make_robot(board=board, i2c_bus=1, pwm_frequency=50) as robot:
        robot.set_motors(0.5, -0.3)
        assert is_driving(chip, board)
    assert not is_driving(chip, board)
    assert set(chip.seen) == {PULSE}


@each_board
def test_through_recovery_from_another_programs_writes(chip, board):
    driver = start(board)
    good = bytes(chip.memory)
    for register, value in [(0x00, 0x00), (0x00, 0x21)] + [(9 + 4 * output, 0x10) for output in OUTPUTS[board]]:
        chip.write_byte_data(0x60, register, value)
        for _ in range(5):
            driver.verify()
            driver.drive(0.5, -0.3)
        assert bytes(chip.memory) == good
    assert set(chip.seen) == {PULSE}


@each_board
def test_through_transfers_that_fail(chip, board):
    for first in range(1, 25):  # more than a start and a command take
        chip.transfers, chip.failing = 0, range(first, first + 3)
        with contextlib.suppress(BusError):
            start(board)
    assert chip.transfers < first
    assert is_driving(chip, board)
    assert set(chip.seen) == {PULSE}


@each_board
def test_through_the_guards_stop_which_writes_the_own_outputs_only(chip, board):
    start(board)
    before = bytes(chip.memory)
    assert try_to_stop(find_board(board), BUS, None) is None
    assert not is_driving(chip, board)
    changed = {register for register in range(256) if chip.memory[register] != before[register]}
    assert changed <= {6 + 4 * output + 3 for output in OUTPUTS[board]}
    assert set(chip.seen) == {PULSE}


@each_board
def test_a_servo_goes_on_at_the_frequency_that_the_motors_need(chip, board):
    start(board, 1526)
    assert chip.pulse(SERVO) == (PULSE[0] * 4 // 122, 1526)
    assert is_driving(chip, board)


@each_board
def test_the_guard_stops_the_wheels_whatever_state_the_chip_is_in(chip, board):
    for mode1, mode2 in STATES:
        start(board)
        for register, value in (0x01, mode2), (0x00, mode1):
            chip.write_byte_data(0x60, register, value)
        assert try_to_stop(find_board(board), BUS, None) is None
        assert not is_driving(chip, board)


@each_board
def test_a_chip_in_any_state_stops_and_drives_after_the_start(chip, board):
    start(board)
    wanted = list(map(chip.high, OUTPUTS[board]))
    for mode1, mode2 in STATES:
        for register, value in (0x01, mode2), (0x00, mode1):
            chip.write_byte_data(0x60, register, value)
        driver = open_board(find_board(board), BUS, 50)
        assert not is_driving(chip, board)
        driver.drive(0.5, -0.3)
        assert (chip.memory[0x00], chip.memory[0x01], chip.memory[0xFE]) == (0x20, 0x04, 121)
        assert list(map(chip.high, OUTPUTS[board])) == wanted
