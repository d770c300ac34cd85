"""A node ends with the roslaunch that started it, and knows a suspended terminal."""

import contextlib
import os
import signal
import subprocess
import sys

import pytest

from conftest import MODULES
from jetbot_ros import launcher

CHILD = f"""
import os, sys
os.write(1, b"started\\n")
os.read(0, 1)  # from here on, the test has arranged what is above
sys.path[:0] = {MODULES!r}
from jetbot_ros.launcher import Launcher
launcher = Launcher()
while True:
    launcher.poll()
    os.write(1, f"{{launcher.ended}} {{launcher.suspended}}\\n".encode())
    if not os.read(0, 1):
        break
"""
ROSLAUNCH = "import subprocess, sys; subprocess.Popen(sys.argv[1:], start_new_session=True).wait()"
LAUNCHED = [sys.executable, "-c", CHILD, "__log:=node.log"]


class Chain:
    """A process started by ``roslaunch``, the command above it, and what it reports of that."""

    def __init__(self, roslaunch, child):
        self._child = child
        self.roslaunch = subprocess.Popen([*roslaunch, *child], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        assert self.roslaunch.stdout.readline() == b"started\n"

    def report(self):
        """Return (ended, suspended)."""
        self.roslaunch.stdin.write(b".")
        self.roslaunch.stdin.flush()
        return tuple(word == b"True" for word in self.roslaunch.stdout.readline().split())

    def kill(self):
        self.roslaunch.kill()
        self.roslaunch.wait()

    def suspend(self):
        os.kill(self.roslaunch.pid, signal.SIGSTOP)
        os.waitid(os.P_PID, self.roslaunch.pid, os.WSTOPPED)


@pytest.fixture
def chain():
    chains = []

    def make(roslaunch=(sys.executable, "-c", ROSLAUNCH), child=LAUNCHED):
        chains.append(Chain(roslaunch, child))
        return chains[-1]

    yield make
    for each in chains:
        with contextlib.suppress(OSError):
            each.roslaunch.stdin.close()  # the child reads its end, and ends
        each.kill()


@pytest.mark.parametrize("between", [[], ["sh", "-c", '"$@"; true', "xterm"]], ids=["", "a program between"])
def test_runs_as_long_as_roslaunch_does(chain, between):
    node = chain(child=[*between, *LAUNCHED])
    assert node.report() == (False, False)
    node.kill()
    assert node.report() == (True, False)


def test_a_node_that_roslaunch_has_not_started_does_not_end_with_its_parent(chain):
    node = chain(child=LAUNCHED[:-1])
    node.kill()
    assert node.report() == (False, False)


@pytest.mark.parametrize("above", [[], ["sh", "-c", '"$@"; true', "shell"]], ids=["roslaunch", "the shell above it"])
def test_a_suspended_terminal_and_fg(chain, above):
    node = chain(roslaunch=[*above, sys.executable, "-c", ROSLAUNCH])
    assert node.report() == (False, False)
    node.suspend()
    assert node.report() == (False, True)
    os.kill(node.roslaunch.pid, signal.SIGCONT)
    os.waitid(os.P_PID, node.roslaunch.pid, os.WCONTINUED)
    assert node.report() == (False, False)


def test_without_proc_only_the_end_of_the_parent_is_known(monkeypatch):
    launcher.stat_file.cache_clear()
    monkeypatch.setattr(launcher, "open", lambda *_, **__: (_ for _ in ()).throw(FileNotFoundError()), raising=False)
    alone = launcher.Launcher(parent=os.getppid(), launched=True)
    assert (alone.ended, alone.suspended) == (False, False)
    assert launcher.Launcher(parent=os.getppid() + 1, launched=True).ended
