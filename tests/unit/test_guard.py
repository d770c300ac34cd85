"""The wheels stop however the process that drives them ends, and turn only while a guard is up."""

import contextlib
import errno
import os
import pty
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path
from unittest.mock import Mock

import pytest

from conftest import SOURCE
from jetbot import BusError, Robot, guard
from jetbot.errors import GuardError
from jetbot.fake.bus import power_on
from jetbot.fake.motors import wheel_speeds
from jetbot.guard import peer
from jetbot.guard.__main__ import is_in_use
from jetbot.wait import wait_until

TIMEOUT = 10.0      # s for a process to start; generous, for slow machines
STOP_TIMEOUT = 3.0  # s


def start(folder, code, **options):
    """Start a Python process with this fake bus."""
    environment = {"PYTHONPATH": str(SOURCE / "src"), "JETBOT_I2C_BUS": f"fake:{folder}", "JETBOT_BOARD": "",
                   **options.pop("env", {})}
    return subprocess.Popen([sys.executable, "-c", code], env={**os.environ, **environment}, **options)


def drive_in_a_process(folder, ending, **options):
    """Start a process that drives full ahead, then runs ``ending``."""
    return start(folder, f"from jetbot import Robot; robot = Robot(); robot.forward()\n{ending}", **options)


def drive_until_killed(folder, preparation="", **options):
    """Return a process that drives."""
    process = start(folder, "import os, time; from jetbot import Robot\n"
                            f"{preparation}\nrobot = Robot(); robot.forward(); time.sleep(60)", **options)
    assert wait_until(lambda: folder.exists() and wheel_speeds(folder) == (1, 1), TIMEOUT)
    return process


def kill(process, signum=signal.SIGKILL):
    process.send_signal(signum)
    process.wait()


def stopped(folder):
    return lambda: wheel_speeds(folder) == (0, 0)


def test_wheels_stop_when_the_interpreter_exits(folder):
    assert drive_in_a_process(folder, "print(end='')").wait() == 0
    assert wheel_speeds(folder) == (0, 0)


def test_a_program_whose_output_is_read_ends_without_waiting_for_the_guard(folder):
    process = drive_in_a_process(folder, "import os; os.unlink(f'{robot.driver.link.name[5:]}/0x60')",
                                 stdout=subprocess.PIPE)
    process.communicate(timeout=10)
    power_on(folder)  # so that the guard ends


def test_a_forked_child_can_neither_drive_nor_hang(folder):
    process = drive_in_a_process(folder, """
import os, threading
def child():
    try:
        robot.backward()
    except Exception as error:
        os._exit(42 if "closed" in str(error) else 1)
    os._exit(2)
def fork():
    status.append(os.waitpid(os.fork() or child(), 0)[1])
status = []
thread = threading.Thread(target=fork)
with robot._lock:
    thread.start()
    thread.join()
robot.forward()
os._exit(os.WEXITSTATUS(status[0]))""")
    assert process.wait(timeout=10) == 42


def test_a_forked_child_does_not_keep_the_guard_waiting(folder):
    process = drive_in_a_process(folder, "import os, time; os.fork() or (time.sleep(3), os._exit(0)); os.abort()")
    process.wait()
    assert wait_until(stopped(folder), STOP_TIMEOUT)


@pytest.mark.parametrize("killer", [signal.SIGKILL, signal.SIGTERM, signal.SIGHUP])
def test_wheels_stop_when_the_process_is_killed(folder, killer):
    kill(drive_until_killed(folder), killer)
    assert wait_until(stopped(folder), STOP_TIMEOUT)


@pytest.mark.parametrize("preparation", [
    "os.chdir('/')",                                    # sys.path holds '', the folder before
    "import sys; sys.path.remove('')",
    "import pathlib, sys; sys.path.insert(0, pathlib.Path())",
    "import signal; signal.signal(signal.SIGCHLD, signal.SIG_IGN)",
])
def test_wheels_stop_whatever_the_program_did_before(folder, preparation):
    kill(drive_until_killed(folder, preparation, cwd=SOURCE / "src",
                            env={"PYTHONPATH": "", "PYTHONINSPECT": "1", "PYTHONWARNINGS": "error"}))
    assert wait_until(stopped(folder), STOP_TIMEOUT)


def full_pipe():
    """Return the end of a pipe that takes no further byte, and the other end."""
    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    with contextlib.suppress(BlockingIOError):
        while True:
            os.write(writer, bytes(4096))
    os.set_blocking(writer, True)
    return writer, reader


def suspended_terminal():
    """Return a terminal after Ctrl-S, and its other end."""
    keyboard, terminal = pty.openpty()
    os.write(keyboard, b"\x13")
    return terminal, keyboard


@pytest.mark.parametrize("make_stderr", [full_pipe, suspended_terminal])
def test_the_guard_stops_the_wheels_while_nobody_reads_its_message(folder, make_stderr):
    stderr, other_end = make_stderr()
    process = drive_until_killed(folder, stderr=stderr)
    (folder / "0x60").rename(folder / "unplugged")
    guards = children(process.pid)
    kill(process)
    assert wait_until(lambda: len(os.listdir(f"/proc/{guards[0]}/task")) > 1, TIMEOUT)  # one waits
    (folder / "unplugged").rename(folder / "0x60")
    assert wait_until(stopped(folder), STOP_TIMEOUT)
    os.close(stderr)
    os.close(other_end)


def children(pid):
    with open(f"/proc/{pid}/task/{pid}/children") as file:
        return [int(child) for child in file.read().split()]


def test_the_guard_needs_no_proc(folder):
    ours, theirs = socket.socketpair()
    process = start(folder, "import pathlib, socket; from jetbot.guard.process import main\n"
                            "pathlib.Path.write_text = lambda *_: open('/nosuch/file')\n"
                            f"main(socket.socket(fileno=0), 'jetbot', 'fake:{folder}')", stdin=theirs)
    theirs.close()
    robot = Robot(i2c_bus=f"fake:{folder}", guard=False)
    robot.forward()
    ours.close()
    assert wait_until(stopped(folder), TIMEOUT)
    assert process.wait() == 0


@pytest.fixture
def guarded_robot(folder):
    """A Robot with a guard."""
    with Robot(i2c_bus=f"fake:{folder}") as robot:
        yield robot


def guard_of(robot):
    """Return the process id of the robot's guard."""
    return robot._guard._peer._process.pid


@pytest.mark.parametrize("signum", [signal.SIGKILL, signal.SIGSTOP])
def test_a_guard_that_is_killed_or_frozen_stops_the_wheels_and_is_replaced(folder, guarded_robot, signum):
    def keep_alive():
        guarded_robot.keep_alive()
        return wheel_speeds(folder)

    guarded_robot.forward()
    first = guard_of(guarded_robot)
    os.kill(first, signum)
    assert wait_until(lambda: keep_alive() == (0, 0), STOP_TIMEOUT)
    assert wait_until(lambda: keep_alive() == (1, 1), TIMEOUT)
    assert guard_of(guarded_robot) != first
    with pytest.raises(ProcessLookupError):
        os.kill(first, 0)


def test_a_guard_lets_a_hung_program_go_on(folder, capfd):
    def keep_alive():
        with contextlib.suppress(BusError):
            robot.keep_alive()
        return robot.guarded

    with Robot(i2c_bus=f"fake:{folder}") as robot:
        robot.forward()
        robot.keep_alive()
        first = guard_of(robot)
        (folder / "0x60").rename(folder / "unplugged")
        assert wait_until(lambda: "wheels may still turn" in capfd.readouterr().err, TIMEOUT)
        assert wait_until(keep_alive, TIMEOUT)
        (folder / "unplugged").rename(folder / "0x60")
        assert wait_until(lambda: keep_alive() and wheel_speeds(folder) == (1, 1), TIMEOUT)
        assert not wait_until(stopped(folder), 0.5)
        assert guard_of(robot) == first


def test_a_program_that_hangs_is_stopped_even_if_a_thread_of_it_asks_for_the_guard(folder, guarded_robot):
    guarded_robot.forward()
    guarded_robot.keep_alive()
    assert wait_until(lambda: guarded_robot.guarded and wheel_speeds(folder) == (0, 0), 2 * STOP_TIMEOUT)


def test_a_command_waits_for_the_guard_with_stopped_wheels(folder, guarded_robot):
    guarded_robot.forward()
    os.kill(guard_of(guarded_robot), signal.SIGKILL)
    assert wait_until(lambda: not guarded_robot.guarded, TIMEOUT)
    seen = []
    watch = threading.Thread(target=lambda: wait_until(lambda: seen.append(wheel_speeds(folder)), 0.3))
    watch.start()
    guarded_robot.forward(0.5)
    assert guarded_robot.guarded and wheel_speeds(folder) == (0.5, 0.5)
    watch.join()
    assert (0, 0) in seen


def test_a_stop_overtakes_a_command_that_waits_for_the_guard(folder, monkeypatch):
    monkeypatch.setattr(peer, "CODE", "import time; time.sleep(60)")
    with Robot(i2c_bus=f"fake:{folder}") as robot:
        stop = threading.Timer(0.1, robot.stop)
        stop.start()
        since = time.monotonic()
        robot.forward()
        assert time.monotonic() - since < guard.WAIT_TIMEOUT
        stop.join()
    assert wheel_speeds(folder) == (0, 0)


@pytest.mark.parametrize("code, cause", [
    ("import time; time.sleep(60)", "it does not answer"),
    (peer.CODE.replace("from", "import nosuch\n    from"), "No module named 'nosuch'"),
])
def test_without_a_guard_nothing_turns_and_one_sentence_says_why(folder, monkeypatch, capfd, code, cause):
    monkeypatch.setattr(peer, "CODE", code)
    monkeypatch.setattr(guard, "WAIT_TIMEOUT", 1.0)
    monkeypatch.setattr(guard, "RESTART_INTERVAL", 0.1)
    with Robot(i2c_bus=f"fake:{folder}") as robot:
        with pytest.raises(GuardError, match=f"^The guard, .* cannot be started: .*{cause}.*\\. Close other"):
            robot.forward()
        assert wheel_speeds(folder) == (robot.left_motor.value, robot.right_motor.value) == (0, 0)
    assert capfd.readouterr().err == ""


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


@pytest.fixture
def listener(tmp_path, monkeypatch):
    """Return a function that starts a guard that listens where JETBOT_GUARD says, and waits until it does."""
    path = tmp_path / "guard"
    monkeypatch.setenv("JETBOT_GUARD", str(path))
    processes = []

    def listen():
        command = [sys.executable, "-m", "jetbot.guard", "--listen", str(path)]
        process = subprocess.Popen(command, env={**os.environ, "PYTHONPATH": str(SOURCE / "src")},
                                   stderr=subprocess.PIPE, text=True)
        processes.append(process)
        assert wait_until(lambda: process.poll() is not None or path.exists() and is_in_use(str(path)), TIMEOUT)
        return process

    yield listen
    for process in processes:
        kill(process)
        process.stderr.close()


def test_a_listening_guard_stops_the_wheels_when_all_of_the_session_is_killed(folder, listener):
    listener()
    process = drive_until_killed(folder, start_new_session=True)
    assert children(process.pid) == []  # it has started no guard
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    assert wait_until(stopped(folder), STOP_TIMEOUT)


def test_a_listening_guard_guards_each_robot(tmp_path, listener):
    listener()
    with Robot(i2c_bus=f"fake:{tmp_path}/one") as robot:
        robot.forward()
        kill(drive_until_killed(tmp_path / "two"))
        assert wait_until(stopped(tmp_path / "two"), STOP_TIMEOUT)
        assert robot.guarded and wheel_speeds(tmp_path / "one") == (1, 1)


def test_nothing_turns_if_the_listening_guard_is_gone_until_it_is_back(folder, listener):
    def keep_alive():
        robot.keep_alive()
        return wheel_speeds(folder)

    first = listener()
    with Robot(i2c_bus=f"fake:{folder}") as robot:
        robot.forward()
        for pid in [*children(first.pid), first.pid]:
            os.kill(pid, signal.SIGKILL)
        assert wait_until(lambda: keep_alive() == (0, 0), STOP_TIMEOUT)
        listener()  # on the socket that the first one has left
        assert wait_until(lambda: keep_alive() == (1, 1), TIMEOUT)


def test_no_guard_listens(folder, monkeypatch):
    monkeypatch.setenv("JETBOT_GUARD", "/nosuch/guard")
    with pytest.raises(GuardError, match="No such file or directory. Start the guard that listens on /nosuch/guard"):
        Robot(i2c_bus=f"fake:{folder}")


def test_a_listening_guard_that_may_not_use_the_board_is_no_guard(folder, listener, monkeypatch):
    monkeypatch.setattr(guard, "RESTART_INTERVAL", 0.1)
    listener()
    with pytest.raises(GuardError, match="it may not use /nosuch/i2c. Start the guard that listens"):
        guard.Guard("jetbot", "/nosuch/i2c").wait(lambda: True)


def test_another_users_guard_is_no_guard(folder, tmp_path, listener, monkeypatch):
    listener()
    assert (tmp_path / "guard").stat().st_mode & 0o777 == 0o600
    monkeypatch.setattr(os, "geteuid", lambda: 12345)
    with pytest.raises(GuardError, match="it belongs to the user "):
        Robot(i2c_bus=f"fake:{folder}")


def test_a_listening_guard_that_was_frozen_and_replaced_stops_nothing(folder, listener):
    def keep_alive():
        robot.keep_alive()
        return wheel_speeds(folder)

    first = listener()
    with Robot(i2c_bus=f"fake:{folder}") as robot:
        robot.forward()
        frozen, = children(first.pid)
        os.kill(frozen, signal.SIGSTOP)
        assert wait_until(lambda: keep_alive() == (0, 0), STOP_TIMEOUT)
        assert wait_until(lambda: keep_alive() == (1, 1), TIMEOUT)
        os.kill(frozen, signal.SIGCONT)
        assert wait_until(lambda: not Path(f"/proc/{frozen}").exists(), TIMEOUT)
        assert wait_until(lambda: keep_alive() == (1, 1), TIMEOUT)  # a heartbeat repeats no command


def test_a_second_listener_is_refused(listener):
    listener()
    second = listener()
    assert second.wait(TIMEOUT) == 1
    assert second.stderr.read().startswith("The guard cannot listen on ")


def test_a_listener_deletes_no_file(tmp_path, listener):
    (tmp_path / "guard").write_text("notes")
    assert listener().wait(TIMEOUT) == 1
    assert (tmp_path / "guard").read_text() == "notes"
