"""The wheels turn only while a guard is up, and a guard that is lost is replaced."""

import contextlib
import errno
import os
import signal
import subprocess
import threading
import time
from unittest.mock import Mock

import pytest
from guarded import STOP_TIMEOUT, TIMEOUT, children, keep_alive, stopped

from jetbot import BusError, Robot, guard
from jetbot.errors import GuardError
from jetbot.fake.motors import wheel_speeds
from jetbot.wait import wait_until

SILENT = "import sys; sys.stdin.read()"  # what a guard runs that never answers
pytestmark = pytest.mark.usefixtures("guards_restart_at_once")


@pytest.fixture
def guarded_robot(folder):
    """A Robot with a guard."""
    with Robot(i2c_bus=f"fake:{folder}") as robot:
        yield robot


def guard_process():
    """Return the process id of the guard that this process has started."""
    return children(os.getpid())[-1]


@pytest.mark.parametrize("signum", [signal.SIGKILL, signal.SIGSTOP])
def test_a_guard_that_is_killed_or_frozen_stops_the_wheels_and_is_replaced(folder, guarded_robot, signum):
    guarded_robot.forward()
    first = guard_process()
    os.kill(first, signum)
    assert wait_until(lambda: keep_alive(guarded_robot, folder) == (0, 0), STOP_TIMEOUT)
    assert wait_until(lambda: keep_alive(guarded_robot, folder) == (1, 1), TIMEOUT)
    assert guard_process() != first
    with pytest.raises(ProcessLookupError):
        os.kill(first, 0)


def test_a_robot_that_is_closed_has_ended_its_guard_which_would_stop_the_next_one(folder):
    with Robot(i2c_bus=f"fake:{folder}"):
        first = guard_process()
    assert first not in children(os.getpid())


@pytest.mark.parametrize("signum", [signal.SIGKILL, signal.SIGSTOP])
def test_a_program_that_only_waits_loses_its_guard_stops_and_drives_again_when_told(folder, guarded_robot, signum):
    guarded_robot.forward()
    os.kill(guard_process(), signum)
    assert wait_until(stopped(folder), STOP_TIMEOUT)
    guarded_robot.forward(0.5)
    assert wheel_speeds(folder) == (0.5, 0.5)


def test_a_guard_lets_a_hung_program_continue(folder, capfd):
    def is_guarded():
        with contextlib.suppress(BusError):
            robot.keep_alive()
        return robot.guarded

    with Robot(i2c_bus=f"fake:{folder}") as robot:
        robot.forward()
        robot.keep_alive()
        first = guard_process()
        (folder / "0x60").rename(folder / "unplugged")
        assert wait_until(lambda: "wheels may still turn" in capfd.readouterr().err, TIMEOUT)
        assert wait_until(is_guarded, TIMEOUT)
        (folder / "unplugged").rename(folder / "0x60")
        assert wait_until(lambda: is_guarded() and wheel_speeds(folder) == (1, 1), TIMEOUT)
        assert not wait_until(stopped(folder), 0.3)
        assert guard_process() == first


def test_a_program_that_hangs_is_stopped_even_if_a_thread_of_it_asks_for_the_guard(folder, guarded_robot):
    guarded_robot.forward()
    guarded_robot.keep_alive()
    assert wait_until(lambda: guarded_robot.guarded and wheel_speeds(folder) == (0, 0), 2 * STOP_TIMEOUT)


def test_a_command_waits_for_the_guard_with_stopped_wheels(folder, guarded_robot):
    guarded_robot.forward()
    os.kill(guard_process(), signal.SIGKILL)
    assert wait_until(lambda: not guarded_robot.guarded, TIMEOUT)
    seen = []
    watch = threading.Thread(target=lambda: wait_until(lambda: seen.append(wheel_speeds(folder)), 0.3))
    watch.start()
    guarded_robot.forward(0.5)
    assert guarded_robot.guarded and wheel_speeds(folder) == (0.5, 0.5)
    watch.join()
    assert (0, 0) in seen


def test_a_stop_overtakes_a_command_that_waits_for_the_guard(folder, monkeypatch):
    monkeypatch.setattr(guard, "CODE", SILENT)
    with Robot(i2c_bus=f"fake:{folder}") as robot:
        stop = threading.Timer(0.1, robot.stop)
        stop.start()
        since = time.monotonic()
        robot.forward()
        assert time.monotonic() - since < guard.TIMEOUT
        stop.join()
    assert wheel_speeds(folder) == (0, 0)


@pytest.mark.parametrize("code, timeout, cause", [(SILENT, 0.2, "it does not answer"), ("", 4.0, "it has ended")])
def test_without_a_guard_nothing_turns_and_one_sentence_says_why(folder, monkeypatch, code, timeout, cause):
    monkeypatch.setattr(guard, "CODE", code)
    monkeypatch.setattr(guard, "TIMEOUT", timeout)
    monkeypatch.setattr(guard, "RESTART_INTERVAL", 2 * timeout)
    with Robot(i2c_bus=f"fake:{folder}") as robot:
        with pytest.raises(GuardError, match=f"^The guard, .* cannot be started: .*{cause}.*\\. Close other"):
            robot.forward()
        assert wheel_speeds(folder) == (robot.left_motor.value, robot.right_motor.value) == (0, 0)


def test_out_of_processes(folder, monkeypatch):
    monkeypatch.setattr(subprocess, "Popen", Mock(side_effect=BlockingIOError(errno.EAGAIN, os.strerror(errno.EAGAIN))))
    with pytest.raises(GuardError, match="cannot be started: Resource temporarily unavailable. Close other programs"):
        Robot(i2c_bus=f"fake:{folder}")


def test_unguarded_by_choice(folder, monkeypatch):
    monkeypatch.setattr(subprocess, "Popen", Mock(side_effect=AssertionError))
    with Robot(i2c_bus=f"fake:{folder}", guard=False) as robot:
        robot.forward()
        robot.keep_alive()
        assert robot.guarded and wheel_speeds(folder) == (1, 1)
