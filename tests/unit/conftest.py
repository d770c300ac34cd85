"""Fixtures of the unit tests: the packages from their source, on a fake bus that counts its transfers."""

import os
import pty
import signal
import sys
import tty
from pathlib import Path
from unittest.mock import Mock

import pytest

ROOT = Path(__file__).parents[2]
PACKAGES = ROOT / "morbot_ws/src"
SOURCE = PACKAGES / "jetbot_control_node"
SIMULATION = PACKAGES / "simulation"
COCKPIT = PACKAGES / "jetbot_cockpit"
TASKS = PACKAGES / "driving_tasks"
LESSONS = PACKAGES / "jetbot_lessons"
TOOLS = PACKAGES / "jetbot_tools"
MODULES = [str(path) for path in sorted(PACKAGES.glob("**/src"))]
PYTHONPATH = os.pathsep.join(MODULES)
signal.signal(signal.SIGHUP, signal.SIG_DFL)  # for the programs that tests start, also below nohup, which ignores it
sys.path[:0] = [*MODULES, str(ROOT / "setup")]

from jetbot import fake, guard, i2c, robot, serial_link  # noqa: E402
from jetbot.boards import BOARDS  # noqa: E402
from jetbot.fake.bus import FakeBus  # noqa: E402


def pytest_configure(config):
    config.addinivalue_line("markers", "node: runs the page's scripts in Node")
    config.addinivalue_line("markers", "shell: starts shell scripts or other programs, most of the time")


def pytest_runtest_setup(item):
    if item.get_closest_marker("node"):
        from javascript import OLDEST, has_node
        if not has_node():
            pytest.skip(f"the page's scripts need Node {OLDEST} or later: sudo apt install nodejs")


class CountedBus(FakeBus):
    """A fake bus that keeps a list of the bits of every transfer, and of the registers after it."""

    bits = []
    states = []

    def _transfer(self, address, wire_bytes, action):
        result = super()._transfer(address, wire_bytes, action)
        self.bits.append(2 + 9 * wire_bytes)
        self.states.append(registers(self._folder, address))
        return result


@pytest.fixture
def wire(monkeypatch):
    """What crossed the fake bus since ``wire.bits.clear()``."""
    monkeypatch.setattr(i2c, "open_bus", lambda name, *chip: CountedBus(fake.folder_of(name), *chip))
    CountedBus.bits.clear()
    CountedBus.states.clear()
    return CountedBus


@pytest.fixture
def six_boards(monkeypatch):
    """BOARDS with those boards alone whose addresses and names a test writes out."""
    for name in set(BOARDS) - {"jetbot", "adafruit", "waveshare", "waveshare_hat", "sparkfun", "jetbot_pro"}:
        monkeypatch.delitem(BOARDS, name)


@pytest.fixture
def folder(tmp_path):
    """A fake bus's folder, not made yet."""
    return tmp_path / "bus"


def registers(folder, address=0x60):
    """The registers of a chip on the fake bus."""
    return fake.chip_file(folder, address).read_bytes()


@pytest.fixture
def port(monkeypatch):
    """A pseudo-terminal: (the board's end, the name of the host's end). A pause of this computer is no failure."""
    monkeypatch.setattr(serial_link, "WRITE_TIMEOUT", 5.0)
    board, host = pty.openpty()
    tty.setraw(board)
    yield board, os.ttyname(host)
    os.close(board)
    os.close(host)


@pytest.fixture
def make_robot(folder, monkeypatch):
    """Makes Robots on the fake bus, without the guard's process, which has tests of its own, and closes them."""
    monkeypatch.setattr(robot, "Guard", lambda *_: Mock())
    robots = []

    def make(**options):
        robots.append(robot.Robot(**{"i2c_bus": f"fake:{folder}", **options}))
        return robots[-1]

    yield make
    robot.close_all(robots)


@pytest.fixture
def guards_restart_at_once(monkeypatch):
    """A guard that is lost is replaced without waiting for a second."""
    monkeypatch.setattr(guard, "RESTART_INTERVAL", 0.1)


def step_of(duties, now):
    """Return a Step of the controller's supervisor that gives the wheels these duties."""
    from jetbot_control_node.control.state_machine import STOPPED, State
    from jetbot_control_node.control.supervisor import Step
    return Step(now, State(1.0), None, STOPPED, duties)
