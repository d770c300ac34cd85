"""Fixtures of the unit tests: the packages from their source, on a fake bus that counts what crosses it."""

import sys
import time
from pathlib import Path

import pytest

SOURCE = Path(__file__).parents[2] / "morbot_ws/src/jetbot_control_node"
SIMULATION = SOURCE.parent / "scenarios/simulation"
sys.path[:0] = [str(SOURCE / "src"), str(SIMULATION / "src")]

from jetbot import i2c, robot  # noqa: E402
from jetbot.fake_i2c import FakeBus  # noqa: E402


class CountedBus(FakeBus):
    """A fake bus that keeps a list of the bits of every transfer, and of the registers after it."""

    bits = []
    states = []

    def _transfer(self, address, wire_bytes, action):
        result = super()._transfer(address, wire_bytes, action)
        self.bits.append(2 + 9 * wire_bytes)
        self.states.append((self._folder / f"0x{address:02x}").read_bytes())
        return result


@pytest.fixture
def wire(monkeypatch):
    """What crossed the fake bus since ``wire.bits.clear()``."""
    monkeypatch.setattr(i2c, "open_bus", lambda name: CountedBus(i2c.fake_folder(name)))
    CountedBus.bits.clear()
    CountedBus.states.clear()
    return CountedBus


@pytest.fixture
def folder(tmp_path):
    """A fake bus's folder, not made yet."""
    return tmp_path / "bus"


@pytest.fixture
def make_robot(folder, monkeypatch):
    """Makes Robots on the fake bus, without the guard's process, and closes them."""
    monkeypatch.setattr(robot, "Guard", NoGuard)
    robots = []

    def make(**options):
        robots.append(robot.Robot(**{"i2c_bus": f"fake:{folder}", **options}))
        return robots[-1]

    yield make
    for each in robots:
        each._close_quietly()


def eventually(condition, within=5.0):
    """Whether the condition becomes true in time."""
    deadline = time.monotonic() + within
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.01)
    return True


class NoGuard:
    """The guard has tests of its own."""

    def __init__(self, *_):
        pass

    def dismiss(self):
        pass

    heartbeat = leave = dismiss
