"""The wire that the benchmark measures on."""

import sys
import time
import timeit
from pathlib import Path

from jetbot.fake.bus import FakeBus

sys.path.append(str(Path(__file__).parents[2] / "bench"))
import wire  # noqa: E402


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
