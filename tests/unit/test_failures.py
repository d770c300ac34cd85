"""A process in which something broke says so in one line, lets what it drives be stopped, and ends."""

import subprocess
import sys

import pytest

from conftest import MODULES

PROGRAM = """
import logging, sys, threading, time
sys.path[:0] = {modules!r}
from jetbot_ros import failures
failures.install()
failures.before_end.append(lambda: print("stopped", flush=True))
def wait():
    time.sleep(60)
def fail():
    raise KeyError("x")
{code}
"""


def run(code):
    return subprocess.run([sys.executable, "-c", PROGRAM.format(modules=MODULES, code=code)], timeout=30, text=True,
                          capture_output=True)


@pytest.mark.parametrize("code, reason", [
    ("threading.Thread(target=fail).start(); wait()", "a thread has failed, KeyError: 'x'"),
    ('raise RuntimeError("can\'t start new thread")', "RuntimeError: can't start new thread"),
    ("threading.Thread(target=failures.lasting(lambda: None, lambda: False)).start(); wait()", "<lambda> has ended"),
    ("raise MemoryError", "MemoryError"),
    ("raise OSError(24, 'Too many open files')", "OSError: [Errno 24] Too many open files"),
    ("raise ImportError('x.so: failed to map segment', name='x')", "ImportError: x.so: failed to map segment"),
    ("threading.Thread(target=fail).start(); failures.before_end.append(lambda: time.sleep(0.1))\n"
     "while not failures._ending.is_set(): pass\nfailures.leave(0)", "a thread has failed, KeyError: 'x'")],
    ids=["thread", "no more threads", "a thread that must last", "no memory", "no file", "no library",
         "while the program ends"])
def test_one_line_a_stop_and_the_end(code, reason):
    ended = run(code)
    assert (ended.returncode, ended.stdout) == (1, "stopped\n")
    assert ended.stderr.startswith(f"[FATAL] -c ends: {reason}. Is this computer out of memory")
    assert ended.stderr.count("\n") == 1


@pytest.mark.parametrize("code", [
    "threading.Thread(target=sys.exit).start()",
    "failures.lasting(lambda: None, lambda: True)()"], ids=["exit of a thread", "at the end"])
def test_what_is_no_failure_ends_nothing(code):
    assert run(f"{code}\nprint('done')").stdout.strip() == "done"


def test_who_can_be_stopped_otherwise_says_so_instead():
    ended = run("failures.install('Use the switch.')\nraise MemoryError")
    assert ended.stderr == "[FATAL] -c ends: MemoryError. Use the switch.\n"


def test_any_other_error_of_the_program_has_its_traceback():
    ended = run("raise KeyError('x')")
    assert ended.stderr.startswith("Traceback") and ended.returncode == 1


def test_a_log_that_cannot_be_written_is_reported_once():
    ended = run("logging.basicConfig(filename='/dev/full')\nfor _ in range(9): logging.error('x')\nprint('done')")
    assert ended.stderr == "[WARN] the log cannot be written: OSError: [Errno 28] No space left on device\n"
    assert ended.stdout.strip() == "done"
