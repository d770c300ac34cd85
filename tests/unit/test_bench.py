"""The benchmark's figures and its report."""

import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from jetbot.fake.bus import FakeBus

sys.path.append(str(Path(__file__).parents[2] / "bench"))

import report  # noqa: E402
import wire  # noqa: E402

PLAN = SimpleNamespace(runs=3, clock=100_000)


@pytest.fixture
def figures(monkeypatch):
    monkeypatch.setattr(report, "machine", lambda: "a Jetson Nano")
    figures = report.Figures()
    for driver, script, floor in ((2, 30, 1), (4, 10, 1), (3, 20, 1)):
        for case in "10 Hz", "50 Hz":
            for name, value in zip(report.COLORS, (driver, script, floor)):
                figures.add("node", name, "delay (ms)", case, value)
                figures.add("node", name, "CPU (%)", case, 10 * value)
    return figures


def page(figures, failures=()):
    return report.text(figures, failures, PLAN, pieces=[47, 245], pace=(0.31, 0.4, 0.03))


def rows(table):
    return [[cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines()]


def test_a_row_is_the_medians_and_their_ratios(figures):
    assert rows(report.table(figures.medians("node")))[2] == ["delay (ms)", "10 Hz", "3", "20", "1", "6.67", "3"]


def test_rows_of_a_quantity_are_adjacent(figures):
    assert [row[:2] for row in rows(report.table(figures.medians("node")))[2:]] == [
        ["delay (ms)", "10 Hz"], ["delay (ms)", "50 Hz"], ["CPU (%)", "10 Hz"], ["CPU (%)", "50 Hz"]]


def test_an_implementation_that_was_left_out_has_no_column():
    figures = report.Figures()
    figures.add("node", "driver", "delay (ms)", "", 3)
    figures.add("node", "floor", "delay (ms)", "", 2)
    header, _, row = rows(report.table(figures.medians("node")))
    assert header == ["", "", "driver", "floor", "driver : floor"]
    assert row == ["delay (ms)", "", "3", "2", "1.5"]


def test_zero_has_no_ratio():
    assert report.ratio(5, 0) == ""


@pytest.mark.parametrize("value, text", [(0, "0"), (0.3694, "0.369"), (11.56, "11.6"), (1155.6, "1,156"),
                                         (55_000.0, "55,000")])
def test_numbers_have_three_digits_and_no_exponent(value, text):
    assert report.number(value) == text


def test_a_failure_is_reported_and_the_rest_is_kept(figures):
    figures.add("node", "floor", "memory (MiB)", "", 48)
    assert rows(report.table(figures.medians("node")))[-1] == ["memory (MiB)", "", "nan", "nan", "48", "nan", "nan"]
    assert "Left out of one run: the script has died." in page(figures, ["the script has died"])


def test_the_page_names_the_machine_and_what_was_run(figures):
    text = " ".join(page(figures).split())
    assert "a Jetson Nano; medians of 3 run(s); buses of 100 kHz" in text
    assert "a write of 29 bits took 0.31 ms (on a wire 0.29)" in text
    assert "2 transfers of 47, 245 bits" in text
    assert "## node | | | driver |" in text


def replay(monkeypatch, drive):
    monkeypatch.setattr(wire, "open_driver", lambda _, folder: lambda *speeds: drive(FakeBus(folder)))
    (command,) = wire.replay("driver", [(0.5, 0.5)])
    return command


def test_only_writes_count_as_a_commands_bits(monkeypatch):
    def drive(bus):
        bus.read_byte_data(0x60, 0x06)
        bus.write_byte_data(0x60, 0x06, 1)

    assert replay(monkeypatch, drive).writes == [29]


def test_the_wire_is_done_with_a_command_when_the_registers_hold_it(monkeypatch):
    def drive(bus):
        for register, value in (0x06, 1), (0x07, 1), (0x06, 1):
            bus.write_byte_data(0x60, register, value)

    command = replay(monkeypatch, drive)
    assert (sum(command.writes), command.wire_bits) == (3 * 29, 2 * 29)


def test_the_fake_bus_takes_as_long_as_a_wire_and_sleeps_meanwhile():
    write, read, cpu = wire.pace(clock=2000, repeat=5)
    assert 14.5 <= write < 2 * 14.5
    assert 19 <= read < 2 * 19
    assert cpu < 0.1 * write
