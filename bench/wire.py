"""What an implementation writes for a command, and the time that the fake bus takes for a transfer."""

import importlib
import random
import tempfile
import time
import timeit
from contextlib import contextmanager
from itertools import product
from pathlib import Path
from statistics import median
from typing import Callable, Iterator, List, NamedTuple, Sequence, Tuple
from unittest.mock import patch

from jetbot.boards import find_board
from jetbot.fake import chip_file
from jetbot.fake.bus import FakeBus, power_on

Speeds = Tuple[float, float]  # left, right, in [-1, 1]
IMPLEMENTATIONS = "driver", "script", "floor"
ADDRESS, LED0_ON_L = 0x60, 0x06
OUTPUTS = slice(LED0_ON_L, 0x46)  # the registers of all outputs


class Command(NamedTuple):
    """What a command leaves in the chip's output registers, and the bits of each of its writes.

    wire_bits: those until the registers first hold the command; later writes change nothing.
    """

    outputs: bytes
    writes: List[int]
    wire_bits: int


def open_driver(implementation: str, folder: str) -> Callable[[float, float], object]:
    """Return the function that drives the robot on the fake bus in a folder at the speeds left, right in [-1, 1]."""
    if implementation == "driver":
        return find_board("jetbot").open(f"fake:{folder}").drive
    return importlib.import_module(implementation).open_driver(folder)


def cruise(count: int) -> List[Speeds]:
    """Return the speeds of a robot that never stops; no pair twice, also in the script's 255 steps."""
    levels = [(level + 0.5) / 255 for level in range(26, 230)]
    return random.Random(1).sample(list(product(levels, levels)), count)


SPEEDS = {  # by what the robot does
    "new speeds": cruise(300),
    "start, stop, reverse": random.Random(1).choices(list(product((-1, -0.5, 0, 0.5, 1), repeat=2)), k=300),
    "the same speeds": [(0.5, 0.6)] * 300,
}


@contextmanager
def fake_bus(clock: int = 0) -> Iterator[str]:
    """Yield the folder of a fake bus of ``clock`` Hz; 0: as fast as it can."""
    with tempfile.TemporaryDirectory(prefix="jetbot_") as folder:
        power_on(folder)
        if clock:
            Path(folder, "clock").write_text(str(clock))
        yield folder


@contextmanager
def recorded_bus() -> Iterator[Tuple[str, list, list]]:
    """Yield the folder of a fake bus, and its writes and its reads: the bits, and the chip's outputs after them."""
    writes, reads, transfer = [], [], FakeBus._transfer
    with fake_bus() as folder:
        def record(bus, address, wire_bytes, action):
            result = transfer(bus, address, wire_bytes, action)
            (writes if result is None else reads).append((2 + 9 * wire_bytes, outputs(folder)))
            return result

        with patch.object(FakeBus, "_transfer", record):
            yield folder, writes, reads


def outputs(folder: str) -> bytes:
    """Return the chip's output registers."""
    return chip_file(folder, ADDRESS).read_bytes()[OUTPUTS]


def replay(implementation: str, speeds: Sequence[Speeds]) -> List[Command]:
    """Return what each command does to a chip that was just started; only writes count."""
    with recorded_bus() as (folder, writes, _):
        drive, commands = open_driver(implementation, folder), []
        for pair in speeds:
            writes.clear()
            drive(*pair)
            final, states = outputs(folder), [state for _, state in writes]
            bits = [bits for bits, _ in writes]
            commands.append(Command(final, bits, sum(bits[:states.index(final) + 1]) if bits else 0))
        return commands


def verification() -> List[int]:
    """Return the bits of the reads with which the driver verifies the chip, one per call, until they repeat."""
    with recorded_bus() as (folder, _, reads):
        driver = find_board("jetbot").open(f"fake:{folder}")
        reads.clear()
        for _ in range(16):
            driver.verify()
        pieces = [bits for bits, _ in reads]
        return pieces[:pieces.index(pieces[0], 1)]


def pace(clock: int, repeat: int = 100) -> Tuple[float, float, float]:
    """Return the ms that a write of 29 and a read of 38 bits take on a bus of ``clock`` Hz, and the CPU time of one."""
    with fake_bus(clock) as folder:
        bus, cpu = FakeBus(folder), time.thread_time()
        write, read = (1000 * median(timeit.repeat(transfer, number=1, repeat=repeat)) for transfer in (
            lambda: bus.write_byte_data(ADDRESS, LED0_ON_L, 0), lambda: bus.read_byte_data(ADDRESS, LED0_ON_L)))
        return write, read, 1000 * (time.thread_time() - cpu) / (2 * repeat)
