"""A guard that runs already, and guards whichever Robot finds it through JETBOT_GUARD."""

import os
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest
from guarded import STOP_TIMEOUT, TIMEOUT, children, drive_until_killed, keep_alive, kill, stopped

from conftest import PYTHONPATH
from jetbot import Robot, guard
from jetbot.errors import GuardError
from jetbot.fake.motors import wheel_speeds
from jetbot.guard.__main__ import is_in_use, serve_in_child
from jetbot.robot import open_robots
from jetbot.wait import wait_until

pytestmark = pytest.mark.usefixtures("guards_restart_at_once")


@pytest.fixture
def listener(tmp_path, monkeypatch):
    """Return a function that starts a guard that listens where JETBOT_GUARD says, and waits until it does."""
    path = tmp_path / "guard"
    monkeypatch.setenv("JETBOT_GUARD", str(path))
    processes = []

    def listen():
        command = [sys.executable, "-m", "jetbot.guard", "--listen", str(path)]
        process = subprocess.Popen(command, env={**os.environ, "PYTHONPATH": PYTHONPATH},
                                   stderr=subprocess.PIPE, text=True)
        processes.append(process)
        assert wait_until(lambda: process.poll() is not None or is_in_use(str(path)), TIMEOUT)
        return process

    yield listen
    for process in processes:
        kill(process)
        process.stderr.close()


def test_a_listening_guard_guards_each_robot_also_when_all_of_its_session_is_killed(tmp_path, listener):
    listener()
    with Robot(i2c_bus=f"fake:{tmp_path}/one") as robot:
        robot.forward()
        process = drive_until_killed(tmp_path / "two", start_new_session=True)
        assert children(process.pid) == []  # it has started no guard
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        assert wait_until(stopped(tmp_path / "two"), STOP_TIMEOUT)
        assert robot.guarded and wheel_speeds(tmp_path / "one") == (1, 1)


def test_a_listening_guard_stops_a_board_at_another_address(folder, listener):
    listener()
    robot = Robot(i2c_bus=f"fake:{folder}", i2c_address=0x61)
    robot.forward()
    robot.detach()  # as a process that is killed
    assert wait_until(lambda: wheel_speeds(folder, "jetbot", 0x61) == (0, 0), STOP_TIMEOUT)
    open_robots.remove(robot)


def test_nothing_turns_if_the_listening_guard_is_gone_until_it_is_back(folder, listener):
    first = listener()
    with Robot(i2c_bus=f"fake:{folder}") as robot:
        robot.forward()
        assert wait_until(lambda: len(children(first.pid)) == 1, TIMEOUT)  # the one of ``listen``'s question has ended
        for pid in [*children(first.pid), first.pid]:
            os.kill(pid, signal.SIGKILL)
        assert wait_until(lambda: keep_alive(robot, folder) == (0, 0), STOP_TIMEOUT)
        listener()  # on the socket that the first one has left
        assert wait_until(lambda: keep_alive(robot, folder) == (1, 1), TIMEOUT)


def test_a_listening_guard_that_was_frozen_and_replaced_stops_nothing(folder, listener):
    first = listener()
    with Robot(i2c_bus=f"fake:{folder}") as robot:
        robot.forward()
        assert wait_until(lambda: len(children(first.pid)) == 1, TIMEOUT)  # the one of ``listen``'s question has ended
        frozen, = children(first.pid)
        os.kill(frozen, signal.SIGSTOP)
        assert wait_until(lambda: keep_alive(robot, folder) == (0, 0), STOP_TIMEOUT)
        assert wait_until(lambda: keep_alive(robot, folder) == (1, 1), TIMEOUT)
        os.kill(frozen, signal.SIGCONT)
        assert wait_until(lambda: not Path(f"/proc/{frozen}").exists(), TIMEOUT)
        assert wait_until(lambda: keep_alive(robot, folder) == (1, 1), TIMEOUT)  # a heartbeat repeats no command


def test_no_guard_listens(folder, monkeypatch):
    monkeypatch.setenv("JETBOT_GUARD", "/nosuch/guard")
    with pytest.raises(GuardError, match="No such file or directory. Start the guard that listens on /nosuch/guard"):
        Robot(i2c_bus=f"fake:{folder}")


def test_a_listening_guard_that_may_not_use_the_board_is_no_guard(listener, monkeypatch):
    monkeypatch.setattr(guard, "TIMEOUT", 5.0)
    listener()
    with pytest.raises(GuardError, match="it may not use /nosuch/i2c. Start the guard that listens"):
        guard.Guard("jetbot", "/nosuch/i2c").wait(lambda: True)


def test_another_users_guard_is_no_guard(folder, tmp_path, listener, monkeypatch):
    listener()
    assert (tmp_path / "guard").stat().st_mode & 0o777 == 0o600
    monkeypatch.setattr(os, "geteuid", lambda: 12345)
    with pytest.raises(GuardError, match="it belongs to the user "):
        Robot(i2c_bus=f"fake:{folder}")


def test_another_user_is_not_guarded(monkeypatch):
    monkeypatch.setattr(os, "geteuid", lambda: 12345)
    monkeypatch.setattr(os, "fork", lambda: pytest.fail("it is served"))
    ours, theirs = socket.socketpair()
    with ours, theirs, pytest.raises(PermissionError):
        serve_in_child(None, theirs)


@pytest.mark.parametrize("first", ["a guard", "a file"])
def test_a_listener_where_another_one_or_a_file_is_refuses_and_deletes_nothing(tmp_path, listener, first):
    (tmp_path / "guard").write_text("notes") if first == "a file" else listener()
    second = listener()
    assert second.wait(TIMEOUT) == 1
    assert second.stderr.read().startswith("The guard cannot listen on ")
    assert is_in_use(str(tmp_path / "guard")) if first == "a guard" else (tmp_path / "guard").read_text() == "notes"
