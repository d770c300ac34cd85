"""The benchmark's figures and its report."""

import sys
import time
import timeit
from pathlib import Path
from statistics import median
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
            for name, value in zip(report.IMPLEMENTATIONS, (driver, script, floor)):
                figures.add("node", name, "delay (ms)", case, value)
                figures.add("node", name, "CPU (%)", case, 10 * value)
    return figures


def page(figures, failures=()):
    return report.text(figures, failures, PLAN)


def rows(table):
    return [[cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines()]


def test_a_row_is_the_medians_and_their_ratios_and_rows_of_a_quantity_are_adjacent(figures):
    row, *others = rows(report.table(figures.medians("node")))[2:]
    assert row == ["delay (ms)", "10 Hz", "3", "20", "1", "6.67", "3"]
    assert [other[:2] for other in others] == [["delay (ms)", "50 Hz"], ["CPU (%)", "10 Hz"], ["CPU (%)", "50 Hz"]]


def test_an_implementation_that_was_left_out_has_no_column():
    figures = report.Figures()
    figures.add("node", "driver", "delay (ms)", "", 3)
    figures.add("node", "floor", "delay (ms)", "", 2)
    figures.add("node", "floor", "bits", "", 0)
    header, _, row, zero = rows(report.table(figures.medians("node")))
    assert header == ["", "", "driver", "floor", "driver : floor"]
    assert row == ["delay (ms)", "", "3", "2", "1.5"]
    assert zero[-1] == "", "zero has no ratio"


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
    assert "## node | | | driver |" in text


def test_a_commands_bits_are_those_of_its_writes_until_the_registers_hold_it(monkeypatch):
    def open_driver(_, folder):
        def drive(*_):
            bus.read_byte_data(0x60, 0x06)
            for register, value in (0x06, 1), (0x07, 1), (0x06, 1):
                bus.write_byte_data(0x60, register, value)

        bus = FakeBus(folder)
        return drive

    monkeypatch.setattr(wire, "open_driver", open_driver)
    (command,) = wire.replay("driver", [(0.5, 0.5)])
    assert (list(command.writes), command.wire_bits) == ([29, 29, 29], 2 * 29)


def test_the_fake_bus_takes_as_long_as_a_wire_and_sleeps_meanwhile():
    with wire.fake_bus(clock=2000) as folder:
        bus = FakeBus(folder)
        for bits, transfer in (29, lambda: bus.write_byte_data(0x60, 6, 0)), (38, lambda: bus.read_byte_data(0x60, 6)):
            cpu, times = time.thread_time(), timeit.repeat(transfer, number=1, repeat=5)
            assert bits / 2000 <= median(times) < 2 * bits / 2000
            assert time.thread_time() - cpu < 0.1 * sum(times)
