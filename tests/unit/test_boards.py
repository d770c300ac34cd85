"""Each board's registers, against a table written from its circuit diagram."""

import itertools
from random import Random
from unittest.mock import Mock

import pytest

from conftest import registers
from jetbot import BusError, InvalidValue, i2c
from jetbot.boards import find_board
from jetbot.connection import open_board, stop_board
from jetbot.fake.bus import FakeBus, power_on
from jetbot.fake.motors import wheel_speeds

OFF, HIGH, HALF = "00000010", "00100000", "00000008"  # the registers of an output
# The outputs (PWM, forward, backward) of the left and the right wheel; where there is no PWM, the direction carries it.
ADAFRUIT = (8, 9, 10), (13, 12, 11)  # the PWMs, then IN2, then IN1 of M1 and M2
WAVESHARE = (None, 1, 0), (None, 2, 3)
WAVESHARE_HAT = (0, 2, 1), (5, 4, 3)  # forward: IN1 low, IN2 high
WHEELS = {"adafruit": ADAFRUIT, "waveshare": WAVESHARE, "jetbot": ADAFRUIT + WAVESHARE, "waveshare_hat": WAVESHARE_HAT}
SPEEDS = (0, 0.5, 1, -0.3, -1)
PAIRS = list(itertools.product(SPEEDS, SPEEDS))


@pytest.mark.parametrize("name", WHEELS)
@pytest.mark.parametrize("speeds", [(0.5, 0.5), (-0.5, -0.5), (-1, 1), (0.5, 0), (0, 0)])
def test_what_each_output_does_at_a_speed_whatever_the_speed_before(folder, name, speeds):
    expected = dict.fromkeys(range(16), OFF)
    for (pwm, forward, backward), speed in zip(WHEELS[name], speeds * 2):
        if speed:
            active, duty = forward if speed > 0 else backward, HIGH if abs(speed) == 1 else HALF
            expected.update({active: duty} if pwm is None else {active: HIGH, pwm: duty})
    board = open_board(find_board(name), f"fake:{folder}")
    for earlier in ((0.7, -0.2), (-0.7, 0.2), (1, 1), (0, 0)):
        board.drive(*earlier)
        board.drive(*speeds)
        held = registers(folder, find_board(name).address)[0x06:]
        assert {output: held[4 * output:][:4].hex() for output in range(16)} == expected


@pytest.mark.parametrize("name", WHEELS)
def test_never_both_directions_at_once_and_few_transfers(folder, wire, name):
    board, random = open_board(find_board(name), f"fake:{folder}"), Random(1)
    ahead = [tuple(random.uniform(0.01, 0.99) for _ in range(2)) for _ in range(300)]
    for number, (before, after) in enumerate([*itertools.product(PAIRS, PAIRS), *zip(ahead, ahead[1:])]):
        board.drive(*before)
        wire.bits.clear()
        wire.states.clear()
        board.drive(*after)
        short = len(wire.bits) <= 3 and sum(wire.bits) <= 160
        assert short or (number < len(PAIRS) ** 2 and len(wire.bits) <= 2 and sum(wire.bits) <= 400)
        for state in wire.states:
            high = {output for output in range(16) if not state[0x09 + 4 * output] & 0x10}
            assert not any({forward, backward} <= high for _, forward, backward in WHEELS[name])


def test_another_chip_is_not_driven(folder, monkeypatch, six_boards):
    monkeypatch.delenv("MORBOT", raising=False)
    power_on(folder)
    row = find_board("waveshare", 0x41)._replace(chip="")  # as on a real bus, which does not know what is meant
    with pytest.raises(BusError) as error:
        open_board(row, f"fake:{folder}")
    assert str(error.value) == (
        f"The chip at 0x41 on fake:{folder} is not the motor board: it does not hold what it is sent. "
        "To find the board, run: rosrun jetbot_tools doctor.py")


def test_the_guards_stop_reads_nothing_and_closes_the_bus(folder, monkeypatch):  # it may try again for ten minutes
    open_board(find_board("adafruit"), f"fake:{folder}").drive(1, 1)
    bus = Mock(wraps=FakeBus(folder))
    monkeypatch.setattr(i2c, "open_bus", lambda *_: bus)
    stop_board(find_board("adafruit"), f"fake:{folder}")
    assert wheel_speeds(folder) == (0, 0)
    *calls, last = [name for name, *_ in bus.mock_calls]
    assert (set(calls), last) == ({"write_byte_data"}, "close")


@pytest.mark.parametrize("board, address, problem", [
    *(("adafruit", address, "The I2C address must be an address from 0x03 to 0x77, not ")
      for address in (0, 0x78, "61h", True, 1.5)),
    ("lego", None, "There is no board 'lego'. Choose one of: jetbot, .*jetbot_pro")])
def test_what_is_no_board_or_no_address_is_refused(board, address, problem):
    with pytest.raises(InvalidValue, match=f"^{problem}"):
        find_board(board, address)
