"""What the chip is sent; and a servo on an output of its own, which keeps its pulse whatever happens to the motors."""

import contextlib

import pytest

from conftest import registers
from jetbot import BusError
from jetbot.boards import find_board, pca9685
from jetbot.boards.pca9685 import PCA9685
from jetbot.connection import open_board
from jetbot.fake import chips
from jetbot.fake.bus import FakeBus, no_answer, power_on
from jetbot.guard.process import try_to_stop
from jetbot.i2c import I2CDevice

SERVO, PULSE = 15, (0x0134 / 4096, pytest.approx(50, abs=0.1))  # its output; 1.5 ms at 50 Hz
OUTPUTS = {"jetbot": (8, 9, 10, 13, 12, 11, 1, 0, 2, 3), "adafruit": (8, 9, 10, 13, 12, 11), "waveshare": (1, 0, 2, 3),
           "waveshare_hat": (0, 1, 2, 5, 3, 4)}
STATES = [(mode1, mode2) for mode1 in (0x00, 0x01, 0x20, 0x21, 0x10, 0x31)
          for mode2 in (0x00, 0x04, 0x0C, 0x14, 0x1C)]  # MODE2 may invert the outputs, or delay what they do


@pytest.fixture
def link(folder):
    return I2CDevice(f"fake:{folder}", 0x60)


@pytest.fixture(params=OUTPUTS)
def board(request):
    return request.param


@pytest.fixture
def servo(folder, wire):
    """A chip at 50 Hz with a servo, as the servo's program sets it up; returns its pulse in a state of the chip."""
    power_on(folder)
    bus = FakeBus(folder)
    for register, value in (0x00, 0x10), (0xFE, 121), (0x00, 0x20), (0x01, 0x04):
        bus.write_byte_data(0x60, register, value)
    bus.write_i2c_block_data(0x60, 6 + 4 * SERVO, [0, 0, 0x34, 0x01])
    return lambda state: (chips.PCA9685.duty(state, SERVO), chips.PCA9685.frequency(state))


def start(board, folder, pwm_frequency=50):
    """Return the driver of a board, driving."""
    driver = open_board(find_board(board, 0x60), f"fake:{folder}", pwm_frequency)
    driver.drive(0.5, -0.3)
    return driver


def guard_stops(board, folder):
    assert try_to_stop(find_board(board, 0x60), f"fake:{folder}", None) is None


def duties(folder, board):
    return [chips.PCA9685.duty(registers(folder), output) for output in OUTPUTS[board]]


def assert_pulse_never_changed(servo, wire):
    assert wire.states
    for state in wire.states:
        assert servo(state) == PULSE


def test_outputs_are_off_before_the_chip_sleeps_and_wakes(link, wire):
    spans = [range(8), range(8, 16)]
    PCA9685(link, 1526, spans).set_outputs(dict.fromkeys(range(16), 4096))
    wire.states.clear()
    PCA9685(link, 50, spans).start()
    off = [state[0x09:0x46:4] == bytes([0x10] * 16) for state in wire.states]
    assert not any(state[0x00] & 0x10 for state in wire.states[:off.index(True)])
    assert all(off[off.index(True):])
    assert wire.states[-1][0xFE] == 121


def test_other_outputs_go_on_by_a_restart_once_the_oscillator_has_started(folder, link, monkeypatch):
    sent = []
    write = I2CDevice.write
    monkeypatch.setattr(I2CDevice, "write", lambda link, *data: sent.append(data) or write(link, *data))
    monkeypatch.setattr(pca9685.time, "sleep", lambda seconds: sent.append(f"{seconds} s"))
    PCA9685(link, 1526, [range(4)]).start()
    sleep = sent.index((0x00, [0x30]))
    assert sent[sleep:sleep + 5] == [(0x00, [0x30]), (0xFE, [3]), (0x00, [0x20]), "0.0005 s", (0x00, [0xA0])]


@pytest.mark.parametrize("changes, counts", [
    ({}, (0, 0)), ({0x00: 0x11, 0x01: 0x04, 0xFE: 0x1E}, (1, 0)), ({0xFE: 0x1E}, (1, 0)), ({0xFE: 0x79}, (0, 1)),
    ({0x00: 0x00}, (0, 1)), ({0x01: 0x14}, (0, 1)), ({0x29: 0x10}, (0, 1))])
def test_a_brown_out_and_what_another_program_writes_are_repaired_and_counted(link, folder, changes, counts):
    chip = PCA9685(link, 1526, [range(8, 14), range(0, 4)])
    chip.set_outputs({8: 100})
    good = registers(folder)
    state = bytearray(good)
    for register, value in changes.items():
        state[register] = value
    (folder / "0x60").write_bytes(state)
    for _ in range(8):
        chip.verify()
        chip.set_outputs({8: 100})
    assert ((chip.resets, chip.overwritten), registers(folder)) == (counts, good)


def test_a_servo_keeps_its_pulse_through_start_and_end(servo, folder, wire, make_robot, board):
    with make_robot(board=board, i2c_address=0x60, pwm_frequency=50) as robot:
        robot.set_motors(0.5, -0.3)
        assert any(duties(folder, board))
    assert not any(duties(folder, board))
    assert_pulse_never_changed(servo, wire)


def test_a_servo_keeps_its_pulse_while_what_other_programs_write_is_repaired(servo, folder, wire, board):
    driver = start(board, folder)
    good = registers(folder)
    for register, value in [(0x00, 0x00), (0x00, 0x21)] + [(9 + 4 * output, 0x10) for output in OUTPUTS[board]]:
        FakeBus(folder).write_byte_data(0x60, register, value)
        for _ in range(5):
            driver.verify()
            driver.drive(0.5, -0.3)
        assert registers(folder) == good
    assert_pulse_never_changed(servo, wire)


def test_a_servo_keeps_its_pulse_through_transfers_that_fail(servo, folder, wire, monkeypatch, board):
    transfers, failing = 0, range(0)
    transfer = wire._transfer

    def fail_some(bus, *arguments):
        nonlocal transfers
        transfers += 1
        if transfers in failing:
            raise no_answer()
        return transfer(bus, *arguments)

    monkeypatch.setattr(wire, "_transfer", fail_some)
    for first in range(1, 25):  # more than a start and a command take
        transfers, failing = 0, range(first, first + 3)
        with contextlib.suppress(BusError):
            start(board, folder)
    assert transfers < first
    assert any(duties(folder, board))
    assert_pulse_never_changed(servo, wire)


def test_the_guards_stop_leaves_other_outputs_alone(servo, folder, wire, board):
    start(board, folder)
    before = registers(folder)
    guard_stops(board, folder)
    assert not any(duties(folder, board))
    changed = {register for register in range(256) if registers(folder)[register] != before[register]}
    assert changed <= {6 + 4 * output + 3 for output in OUTPUTS[board]}
    assert_pulse_never_changed(servo, wire)


def test_a_servo_goes_on_at_the_frequency_that_the_motors_need(servo, folder, board):
    start(board, folder, 1526)
    assert servo(registers(folder)) == (PULSE[0], pytest.approx(1526, abs=1))
    assert any(duties(folder, board))


@pytest.mark.parametrize("stop", [guard_stops, start])
def test_whatever_state_the_chip_is_in_the_guard_stops_it_and_a_start_drives_it(servo, folder, wire, board, stop):
    start(board, folder)
    wanted = duties(folder, board)
    for mode1, mode2 in STATES:
        for register, value in (0x01, mode2), (0x00, mode1):
            FakeBus(folder).write_byte_data(0x60, register, value)
        wire.states.clear()
        stop(board, folder)
        assert wire.states[0][0x01] == 0x04, "MODE2 comes first, as it may delay or invert the outputs"
        assert any(not {state[9 + 4 * output] for output in OUTPUTS[board]} - {0x10} for state in wire.states)
        start(board, folder)
        assert [registers(folder)[register] for register in (0x00, 0x01, 0xFE)] == [0x20, 0x04, 121]
        assert duties(folder, board) == wanted
