"""What an implementation writes for a command, and a fake bus that takes the time of a real one. Without ROS."""

import importlib
import random
import tempfile
from contextlib import contextmanager
from itertools import product
from pathlib import Path
from typing import Callable, Iterator, List, NamedTuple, Sequence, Tuple
from unittest.mock import patch

from jetbot.boards import find_board
from jetbot.connection import open_board
from jetbot.fake import chip_file
from jetbot.fake.bus import FakeBus, power_on

Speeds = Tuple[float, float]  # left, right, in [-1, 1]
ADDRESS, OUTPUTS = 0x60, slice(0x06, 0x46)  # the chip, and its registers of all outputs


class Command(NamedTuple):
    """What a command leaves in the chip's output registers, and the bits of each of its writes.

    wire_bits: those until the registers first hold the command; later writes change nothing.
    """

    outputs: bytes
    writes: Sequence[int]
    wire_bits: int


def open_driver(implementation: str, folder: str) -> Callable[[float, float], object]:
    """Return the function that drives the robot on the fake bus in a folder at the speeds left, right in [-1, 1]."""
    if implementation == "driver":
        return open_board(find_board("jetbot"), f"fake:{folder}").drive
    return importlib.import_module(implementation).open_driver(folder)


def cruise(count: int) -> List[Speeds]:
    """Return the speeds of a robot that never stops; no pair twice, also in the script's 255 steps."""
    levels = [(level + 0.5) / 255 for level in range(26, 230)]
    return random.Random(1).sample(list(product(levels, levels)), count)


@contextmanager
def fake_bus(clock: int = 0) -> Iterator[str]:
    """Yield the folder of a fake bus of ``clock`` Hz; 0: as fast as it can."""
    with tempfile.TemporaryDirectory(prefix="jetbot_") as folder:
        power_on(folder)
        if clock:
            Path(folder, "clock").write_text(str(clock))
        yield folder


def replay(implementation: str, speeds: Sequence[Speeds]) -> List[Command]:
    """Return what each command does to a chip that was just started; only writes count."""
    writes, transfer = [], FakeBus._transfer

    def outputs():
        return chip_file(folder, ADDRESS).read_bytes()[OUTPUTS]

    def record(bus, address, wire_bytes, action):
        result = transfer(bus, address, wire_bytes, action)
        if result is None:  # a write
            writes.append((2 + 9 * wire_bytes, outputs()))
        return result

    with fake_bus() as folder, patch.object(FakeBus, "_transfer", record):
        drive, commands = open_driver(implementation, folder), []
        for pair in speeds:
            writes.clear()
            drive(*pair)
            bits, states = zip(*writes) if writes else ((), (outputs(),))
            commands.append(Command(outputs(), bits, sum(bits[:states.index(outputs()) + 1])))
        return commands
