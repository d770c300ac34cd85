"""What a driver sends for a command, and what that takes."""

import random
import tempfile
import timeit
from contextlib import contextmanager
from itertools import product
from pathlib import Path
from statistics import median
from unittest.mock import patch

import baseline
import floor

from jetbot.boards import Options, open_board
from jetbot.fake.bus import FakeBus, power_on

OURS, BASELINE, FLOOR = CONTESTANTS = "this driver", "workshop's script", "floor"


def open_ours(folder):
    return open_board("jetbot", Options(i2c_bus=f"fake:{folder}")).drive


# contestant: what makes, from a fake bus's folder, a function of the speeds (left, right)
DRIVERS = {OURS: open_ours, BASELINE: baseline.open_driver, FLOOR: floor.open_driver}


def cruise(count):
    """Speeds (left, right) of a robot that drives on; no pair twice, also where a speed is one of 255 steps."""
    levels = [(level + 0.5) / 255 for level in range(26, 230)]
    return random.Random(1).sample(list(product(levels, levels)), count)


def turns(count):
    """Speeds (left, right) of a robot that starts, stops and turns round."""
    return random.Random(1).choices(list(product((-1, -0.5, 0, 0.5, 1), repeat=2)), k=count)


SPEEDS = {"other speeds": cruise(300), "start, stop, turn round": turns(300), "the same speeds": [(0.5, 0.6)] * 300}


@contextmanager
def fake_bus():
    """The folder of a fake bus."""
    with tempfile.TemporaryDirectory(prefix="jetbot_") as folder:
        power_on(folder)
        yield folder


@contextmanager
def counted():
    """A list of the bits of every transfer from now on, as the fake bus counts them."""
    bits, transfer = [], FakeBus._transfer

    def count(bus, address, wire_bytes, action):
        bits.append(2 + 9 * wire_bytes)
        return transfer(bus, address, wire_bytes, action)

    with patch.object(FakeBus, "_transfer", count):
        yield bits


def cost(contestant, speeds):
    """Transfers and bits a command, on average; the first command does not count."""
    with fake_bus() as folder, counted() as bits:
        drive = DRIVERS[contestant](folder)
        drive(*speeds[0])
        bits.clear()
        for pair in speeds[1:]:
            drive(*pair)
        return len(bits) / (len(speeds) - 1), sum(bits) / (len(speeds) - 1)


def cost_of_check():
    """Transfers and bits of this driver's look at the chip."""
    with fake_bus() as folder, counted() as bits:
        board = open_board("jetbot", Options(i2c_bus=f"fake:{folder}"))
        bits.clear()
        board.refresh(0, 0, idle=True)
        return len(bits), sum(bits)


def pace():
    """Milliseconds that 29 bits take on a fake bus of 100 kHz, where a wire takes 0.29: the median of 100."""
    with fake_bus() as folder:
        Path(folder, "clock").write_text("100000")
        bus = FakeBus(folder)
        return 1000 * median(timeit.repeat(lambda: bus.write_byte_data(0x60, 0x06, 0), number=1, repeat=100))
