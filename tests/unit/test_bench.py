"""The benchmark's tables, and the wire that it measures on."""

import sys
import time
import timeit
from pathlib import Path

import pytest

from jetbot.fake.bus import FakeBus

sys.path.append(str(Path(__file__).parents[2] / "bench"))
import wire  # noqa: E402


def test_a_table_has_medians_their_ratios_and_the_cases_of_a_quantity_together():
    pytest.importorskip("rospy")
    import bench

    figures = {(quantity, case): {"driver": [2, 4, 3], "script": [30, 10, 2000], "floor": [floor]}
               for case in ("10 Hz", "50 Hz") for quantity, floor in (("delay (ms)", 1.234), ("CPU (%)", 0))}
    del figures["CPU (%)", "50 Hz"]["script"]
    assert bench.table(figures).splitlines() == [
        "|  |  | driver | script | floor | script : driver | driver : floor |",
        "| --- | --- | ---: | ---: | ---: | ---: | ---: |",
        "| delay (ms) | 10 Hz | 3 | 30 | 1.23 | 10 | 2.43 |",
        "| delay (ms) | 50 Hz | 3 | 30 | 1.23 | 10 | 2.43 |",
        "| CPU (%) | 10 Hz | 3 | 30 | 0 | 10 |  |",
        "| CPU (%) | 50 Hz | 3 |  | 0 |  |  |"]
    assert bench.table({("delay (ms)", ""): {"driver": [12345.6]}}).endswith("| delay (ms) |  | 12,346 |\n")


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
            assert bits / 2000 <= min(times) < 2 * bits / 2000
            assert time.thread_time() - cpu < 0.1 * sum(times)
