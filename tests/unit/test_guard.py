"""The wheels stop however the process that drives them ends."""

import os
import signal
import subprocess
import sys

import pytest

from conftest import SOURCE
from jetbot.fake.bus import power_on
from jetbot.fake.motors import wheel_speeds
from jetbot.wait import wait_until

TIMEOUT = 5.0  # s for a process to start


def drive_in_a_process(folder, ending, **options):
    """Start a process that drives full ahead, then runs ``ending``."""
    return subprocess.Popen(
        [sys.executable, "-c", f"from jetbot import Robot; robot = Robot(); robot.forward()\n{ending}"],
        env={**os.environ, "PYTHONPATH": str(SOURCE / "src"), "JETBOT_I2C_BUS": f"fake:{folder}", "JETBOT_BOARD": ""},
        **options)


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
    assert wait_until(lambda: wheel_speeds(folder) == (0, 0), 1.5)


@pytest.mark.parametrize("killer", [signal.SIGKILL, signal.SIGTERM, signal.SIGHUP])
def test_wheels_stop_when_the_process_is_killed(folder, killer):
    process = drive_in_a_process(folder, "import time; time.sleep(60)")
    assert wait_until(lambda: folder.exists() and wheel_speeds(folder) == (1, 1), TIMEOUT)
    process.send_signal(killer)
    process.wait()
    assert wait_until(lambda: wheel_speeds(folder) == (0, 0), 1.5)
