"""Processes that drive, for the tests of the guard."""

import os
import signal
import subprocess
import sys

from conftest import PYTHONPATH
from jetbot.fake.motors import wheel_speeds
from jetbot.wait import wait_until

TIMEOUT = 10.0      # s for a process to start; generous, for slow machines
STOP_TIMEOUT = 3.0  # s


def start(folder, code, **options):
    """Start a Python process with this fake bus."""
    environment = {"PYTHONPATH": PYTHONPATH, "JETBOT_I2C_BUS": f"fake:{folder}", "JETBOT_BOARD": "",
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


def keep_alive(robot, folder):
    """Feed the guard, and return the speeds of the wheels then."""
    robot.keep_alive()
    return wheel_speeds(folder)


def children(pid):
    with open(f"/proc/{pid}/task/{pid}/children") as file:
        return [int(child) for child in file.read().split()]
