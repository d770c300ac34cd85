"""The wheels stop however the process that drives them ends."""

import contextlib
import os
import pty
import signal
import subprocess

import pytest
from guarded import STOP_TIMEOUT, TIMEOUT, children, drive_in_a_process, drive_until_killed, kill, stopped

from conftest import PACKAGES
from jetbot.fake.bus import power_on
from jetbot.fake.motors import wheel_speeds
from jetbot.wait import wait_until


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


@pytest.mark.parametrize("killer", [signal.SIGKILL, signal.SIGTERM, os.killpg])
def test_wheels_stop_when_the_process_or_all_of_its_group_is_killed(folder, killer):
    process = drive_until_killed(folder, start_new_session=True)
    os.killpg(process.pid, signal.SIGKILL) if killer is os.killpg else process.send_signal(killer)
    process.wait()
    assert wait_until(stopped(folder), STOP_TIMEOUT)


@pytest.mark.parametrize("preparation", [
    "os.chdir('/')",                                    # sys.path holds '', the folder before
    "import sys; sys.path.remove('')",
    "import pathlib, sys; sys.path.insert(0, pathlib.Path())",
    "import signal; signal.signal(signal.SIGCHLD, signal.SIG_IGN)",
])
def test_wheels_stop_whatever_the_program_did_before(folder, preparation):
    kill(drive_until_killed(folder, preparation, cwd=PACKAGES / "jetbot/src",
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
