"""Whatever interrupts a transfer, no wheel gets faster than before and after, nor turns a way that neither has."""

import functools
import itertools
import os
from random import Random

import another_chip
import pytest

from jetbot import BusError, i2c
from jetbot.boards import BOARDS, MotorDriver, find_board, pca9685
from jetbot.connection import connect, open_board
from jetbot.fake.bus import FakeBus, no_answer
from jetbot.fake.chips import chip_class

BUS = "/dev/i2c-1"
ROWS = {**BOARDS, **another_chip.ROWS}
# A board on an I2C bus: the boards whose wiring its robot may have. `jetbot` drives both layouts.
WIRINGS = {board: (board,) for board, row in ROWS.items() if row.address}
WIRINGS["jetbot"] = ("adafruit", "waveshare")
STEP = 1 / 4096
ATTEMPTS = 50  # of a command, more than any driver needs
CHANGES = 10_000 if "MODEL_CHECK" in os.environ else 400  # of each board
TABLE = (0, STEP, 255 * STEP, 256 * STEP, 0.5, 1, -STEP, -0.7, -1)
NACK_AND_STOP, BROWN_OUT, CUT = "not acknowledged, then STOP", "brown-out", "cable cut, no STOP"
FAULTS = [(NACK_AND_STOP, 0), (NACK_AND_STOP, 2), (BROWN_OUT, 0), (BROWN_OUT, 2), (CUT, 6)]


class InterruptedChip(FakeBus):
    """A bus in memory, with a chip of ``jetbot.fake.chips``, which takes each byte by itself.

    The outputs of a PCA9685 change at the STOP of a transfer (OCH = 0); after a cut, its bytes take effect at the next
    STOP. ``interrupt`` lets one byte fail. seen: the registers after every byte, as a transfer may end there with a
    STOP.
    """

    def __init__(self, board):
        self.chip = chip_class(BOARDS[board].chip)
        self.registers = bytearray(self.chip.POWER_ON)
        self.seen = []
        self.bytes = 0
        self._fault, self._refused, self._refused_later = None, 0, 0

    def interrupt(self, after, kind, refused=0):
        """Let the fault happen after so many bytes; ``refused``: how many transfers after it fail too."""
        self.bytes, self._fault, self._refused_later = 0, (after, kind), refused

    @property
    def was_interrupted(self):
        """Whether no fault is pending."""
        return self._fault is None

    def read_i2c_block_data(self, address, register, length):
        self._carry(3 + length)  # address, register, address
        return self.chip.read(self.registers, register, length)

    def write_i2c_block_data(self, address, register, data):
        self._carry(2 + len(data), register, data)

    def _carry(self, length, register=0, data=()):
        """Carry so many bytes, the last of which are the data for the registers from this one on."""
        if self._refused:
            self._refused -= 1
            raise no_answer()
        carried = min(length, self._fault[0] - self.bytes) if self._fault else length
        self.bytes += carried
        states = after_each_byte(self.chip, bytes(self.registers), register, tuple(data))[:max(0, carried - 2)]
        if states:
            self.registers[:] = states[-1]
            self.seen += states
        if carried < length:
            kind, self._fault, self._refused = self._fault[1], None, self._refused_later
            if kind == BROWN_OUT:
                self.registers[:] = self.chip.POWER_ON
            raise no_answer()


@functools.lru_cache(maxsize=1000)
def after_each_byte(chip, registers, register, data):
    """The registers of a chip after each byte of a transfer, in case that it ends there."""
    states = []
    for end in range(1, len(data) + 1):
        changed = bytearray(registers)
        chip.write(changed, register, data[:end])
        states.append(bytes(changed))
    return states


@functools.lru_cache(maxsize=100_000)
def wheels(registers, board):
    """The speeds (left, right) of the simulated robot with this board and these registers, as bytes."""
    row = BOARDS[board]
    return tuple(chip_class(row.chip).speed(registers, motor, 0.0) for motor in (row.left, row.right))


def faults(board):
    """The faults that this board's driver repairs: one that reads nothing back does not notice a brown-out."""
    reads_back = ROWS[board].driver.verify is not MotorDriver.verify
    return [fault for fault in FAULTS if reads_back or fault[0] != BROWN_OUT]


each_fault = pytest.mark.parametrize("board, fault", [(board, fault) for board in WIRINGS for fault in faults(board)])


@pytest.fixture
def chip(board, monkeypatch):
    monkeypatch.setitem(BOARDS, board, ROWS[board])
    chip = InterruptedChip(board)
    monkeypatch.setattr(i2c, "open_bus", lambda *_: chip)
    monkeypatch.setattr(i2c, "bus_advice", lambda: "")
    monkeypatch.setattr(pca9685.time, "sleep", lambda seconds: None)
    return chip


def exact(board, speeds):
    """The speeds, as the chip counts them; SparkFun's cannot drive full backward."""
    steps = round(1 / BOARDS[board].driver.resolution)
    return tuple(max(1 - steps if board == "sparkfun" else -steps, round(steps * speed)) / steps for speed in speeds)


def limits(board, before, after):
    """The least and the greatest speed of a wheel in between: those of both ends.

    Only a PCA9685 may be faster, while OFF_L, which comes first, is new and OFF_H is old.
    """
    steps = round(1 / BOARDS[board].driver.resolution)
    duties = [round(steps * abs(speed)) for speed in (before, after)]
    if BOARDS[board].chip == "PCA9685" and 0 < min(duties) and max(duties) < steps:
        duties.append(duties[0] & 0xF00 | duties[1] & 0xFF)
    fastest = max(duties) / steps
    return -fastest if min(before, after) < 0 else 0, fastest if max(before, after) > 0 else 0


def check(chip, board, before, after):
    """Each wheel stayed between both ends, and now turns as commanded."""
    before, after = exact(board, before), exact(board, after)
    allowed = [limits(board, *ends) for ends in zip(before, after)]
    for robot in WIRINGS[board]:
        for registers in set(chip.seen):
            for (least, greatest), now in zip(allowed, wheels(registers, robot)):
                assert least <= now <= greatest, (robot, before, after, registers.hex(" "))
        assert wheels(bytes(chip.registers), robot) == after
    chip.seen.clear()


def length(chip, action, *arguments):
    """Return how many bytes an action takes."""
    chip.bytes = 0
    action(*arguments)
    return chip.bytes


def speeds(registers, board):
    """The speeds of all wheels that the board may have."""
    return tuple(itertools.chain(*(wheels(registers, robot) for robot in WIRINGS[board])))


def drive(chip, driver, speeds):
    """Drive as the supervisor does: again after a failure, with read-back, until all is good after the interruption.

    A driver may send less than was to be interrupted.
    """
    good = 0
    for _ in range(ATTEMPTS):
        try:
            driver.drive(*speeds)
            driver.verify()
            driver.keep_alive()
            good += chip.was_interrupted
        except BusError:
            good = 0
            assert not driver.in_sync
        if good > 5:
            break


@pytest.mark.parametrize("board", WIRINGS)
def test_random_changes(chip, board):
    random, before = Random(1), (0, 0)
    driver = open_board(find_board(board), BUS)
    for _ in range(CHANGES):
        after = tuple(random.choice((random.uniform(-1, 1), max(-1.0, speed - random.random() / 10), *TABLE))
                      for speed in before)
        chip.interrupt(random.randrange(30), *random.choice(faults(board)))
        drive(chip, driver, after)
        check(chip, board, before, after)
        before = after


@each_fault
@pytest.mark.parametrize("frequency", [1526, 50])  # as it runs already; another one, for which the chip has to sleep
def test_every_byte_of_the_set_up_and_the_first_command(chip, board, fault, frequency):
    before, after = (0.5, -0.5), (STEP, STEP)

    def new_driver():
        return connect(find_board(board), BUS, frequency)

    for byte in range(length(chip, new_driver().drive, *after)):
        drive(chip, open_board(find_board(board), BUS), before)
        chip.seen.clear()
        chip.interrupt(byte, *fault)
        drive(chip, new_driver(), after)
        check(chip, board, before, after)


@pytest.mark.parametrize("board", WIRINGS)
@pytest.mark.parametrize("fault", [NACK_AND_STOP, BROWN_OUT, CUT])
def test_every_byte_while_the_board_is_opened(chip, board, fault):
    for byte in range(length(chip, open_board, find_board(board), BUS)):
        chip.registers[:] = chip.chip.POWER_ON
        chip.interrupt(byte, fault)
        driver = open_board(find_board(board), BUS)
        driver.drive(0.5, -0.5)
        assert {speeds(bytes(chip.registers), board)} == {exact(board, (0.5, -0.5)) * len(WIRINGS[board])}


@pytest.mark.parametrize("board", WIRINGS)
def test_after_a_failed_change_the_next_command_first_stops_the_wheels(chip, board):
    before, after, next_one = (1, 0.5), (0.5, -1), (-1, -0.5)
    driver = open_board(find_board(board), BUS)
    driver.drive(*before)
    for byte in range(length(chip, driver.drive, *after)):
        drive(chip, driver, before)
        chip.interrupt(byte, NACK_AND_STOP, refused=2)
        with pytest.raises(BusError):
            driver.drive(*after)
        held, chip.seen = speeds(bytes(chip.registers), board), []
        driver.drive(*next_one)
        seen = [speeds(registers, board) for registers in chip.seen]
        for state in seen[:seen.index((0,) * len(held))]:
            assert all(now in (0, before) for now, before in zip(state, held))
