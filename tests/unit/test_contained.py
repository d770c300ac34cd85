"""What runs in a child with limits: whatever it does, the program goes on with a sentence about it."""

import contextlib
import ctypes
import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace
from unittest.mock import Mock, call

import pytest

from driving_tasks import contained
from driving_tasks.contained import Limits, run
from jetbot.wait import wait_until

ENVIRONMENT = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
SMALL = Limits(memory=200, cpu_time=1, wall_time=60)


def fail():
    raise ValueError("It is not a rosbag.")


def spin():
    while True:
        pass


def write(file):
    with open(file, "w") as stream:
        stream.write("x")


@pytest.mark.parametrize("function, arguments, problem", [
    (fail, (), "It is not a rosbag."),
    (bytes, (10 ** 9,), "It needs more than 200 MB of memory."),
    (os._exit, (3,), "It needs more than 200 MB of memory, or breaks what reads or runs it."),
    (spin, (), "It takes more than 1 s of CPU time."),
], ids=["error", "memory", "crash", "endless"])
def test_what_fails_in_a_child_is_a_problem_in_one_sentence(function, arguments, problem):
    assert run(function, *arguments, limits=SMALL) == (None, problem)


def test_processes_of_others_may_end_while_they_are_listed(monkeypatch):
    monkeypatch.setattr(os, "listdir", Mock(return_value=["version", str(2 ** 31), str(os.getpid())]))
    assert run(int, "3").value == 3


def test_a_child_prints_nothing_and_returns_much(capfd):
    assert run(os.system, "echo hello; echo hello >&2").value == 0
    assert len(run(bytes, 10 ** 7).value) == 10 ** 7
    assert capfd.readouterr() == ("", "")


def test_a_child_writes_no_file(tmp_path):
    assert "File too large" in run(write, tmp_path / "new").problem
    assert (tmp_path / "new").stat().st_size == 0


@pytest.fixture(params=[True, False], ids=["in a PID namespace", "as in most containers"])
def is_isolated(request, monkeypatch):
    if request.param and not contained.can_isolate():
        pytest.skip("no PID namespaces here")
    monkeypatch.setattr(contained, "can_isolate", lambda: request.param)
    return request.param


def start_hostile(folder, lines):
    """Start a program whose child, in a session of its own, runs these lines; return once they have run."""
    program = f"import os, signal, time\nup = os.getppid()\nif os.fork() == 0:\n    os.setsid()\n" \
              f"    open('begun', 'w').close()\n    {lines}\n    open('ready', 'w').close()\n    time.sleep(60)"
    contained.start([sys.executable, "-c", program, str(folder)], folder, folder / "log")
    return wait_until((folder / "ready").exists, 10)


def running(folder):
    """Return the ids of the processes that ``start_hostile`` has started for this folder."""
    ids = []
    for process in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):  # it has just ended
            if (process / "cmdline").read_bytes().endswith(b"\0%b\0" % os.fsencode(folder)):
                ids.append(process.name)
    return ids


UNPRIVILEGED = 54321  # a user without any process
PR_SET_DUMPABLE, PR_GET_CHILD_SUBREAPER = 4, 37  # of prctl(2)


def explode():
    """Be a bomb of processes, each in a session of its own; return how many there are once there is no room for more.

    Each process ends by itself after 20 s, whatever should have ended it.
    """
    first, end = os.getpid(), time.monotonic() + 20
    while time.monotonic() < end:
        try:
            if os.fork() == 0:
                os.setsid()
        except BlockingIOError:
            if os.getpid() == first:
                return len(contained._descendants(()))
    os._exit(1)


def run_bomb(answer):
    """Send the outcome of a bomb, and what it has left. Root runs it as a user whose processes Linux limits."""
    if os.getuid() == 0:
        os.setgroups([])
        os.setgid(UNPRIVILEGED)
        os.setuid(UNPRIVILEGED)
        contained.libc.prctl(PR_SET_DUMPABLE, 1)  # else /proc/self belongs to root
    most = contained._count_threads() + 3 * contained.MAX_PROCESSES  # however wrong the code is that this tests
    resource.setrlimit(resource.RLIMIT_NPROC, (most, most))
    answer.send((run(explode), contained.children()))


@pytest.mark.parametrize("lines, problem", [
    ("signal.signal(signal.SIGTERM, signal.SIG_IGN)", ""),
    ("os.fork() and os._exit(0)", ""),
    ("os.kill(up, signal.SIGKILL)", "It needs more than 200 MB of memory, or breaks what reads or runs it."),
    ("os.kill(up, signal.SIGSTOP)", "It takes more than 3 s."),
    ("for each in range(1, 32): os.kill(up, each)",
     "It needs more than 200 MB of memory, or breaks what reads or runs it.")],
    ids=["ignores", "daemon", "kills", "stops", "sends all signals"])
def test_nothing_outlives_what_a_child_has_started(tmp_path, monkeypatch, is_isolated, lines, problem):
    limits = SMALL._replace(file_size=1)
    if "STOP" in lines and not is_isolated:
        monkeypatch.setattr(contained, "END_TIMEOUT", 1.0)
        limits = limits._replace(wall_time=3.0)
    outcome = run(start_hostile, tmp_path, lines, limits=limits)
    assert outcome == ((True, "") if is_isolated and "each" not in lines or not problem else (None, problem))
    assert (tmp_path / "begun").exists() and not running(tmp_path)
    assert not contained.children()


def test_a_fork_bomb_ends(is_isolated):
    pipe, answer = contained.FORK.Pipe(duplex=False)
    child = contained.FORK.Process(target=run_bomb, args=(answer,))
    child.start()
    answer.close()  # each process of the bomb has it open, too
    try:
        (size, problem), left = pipe.recv()
        assert (problem, left) == ("", [])
        assert size < 2 * contained.MAX_PROCESSES  # also if other processes of this user end meanwhile
        child.join()
        assert pipe.poll(1), "some of its processes run on"
    finally:
        pipe.poll(30)


def test_all_is_stopped_before_the_first_is_killed(monkeypatch):
    monkeypatch.setattr(contained, "_descendants", Mock(side_effect=[{8}, {8, 9}, {8, 9}, set()]))
    kill = Mock()
    monkeypatch.setattr(os, "kill", kill)
    contained.end_children()
    assert kill.mock_calls == [call(8, signal.SIGSTOP), call(8, signal.SIGSTOP), call(9, signal.SIGSTOP),
                               call(8, signal.SIGKILL), call(9, signal.SIGKILL)]


def test_what_does_not_end_is_named(monkeypatch):
    monkeypatch.setattr(contained, "can_isolate", lambda: False)
    with monkeypatch.context() as patch:
        patch.setattr(contained, "END_TIMEOUT", 0.1)
        no_signals = {"SIGSTOP": 0, "SIGKILL": 0}  # kill(2)
        patch.setattr(contained, "signal", SimpleNamespace(**{**vars(signal), **no_signals}))
        value, problem = run(os.spawnlp, os.P_NOWAIT, "sleep", "sleep", "60")
    left, adopts = contained.children(), ctypes.c_int()
    contained.libc.prctl(PR_GET_CHILD_SUBREAPER, ctypes.byref(adopts))
    assert not contained.end_children()
    contained.libc.prctl(contained.PR_SET_CHILD_SUBREAPER, 0)
    assert (value, problem) == (None, f"Some of its processes do not end. End them by hand: kill -9 {left[0]}")
    assert adopts.value


@pytest.mark.skipif(not contained.can_isolate(), reason="no PID namespaces here")
def test_nothing_in_a_namespace_reaches_the_judge(tmp_path):
    lines = f"assert not os.path.exists('/proc/{os.getpid()}')"
    assert run(start_hostile, tmp_path, lines, limits=SMALL._replace(file_size=1)).value


@pytest.mark.parametrize("signum, printed", [(signal.SIGKILL, b""), (signal.SIGINT, b"cancelled\n")])
def test_the_child_ends_with_the_program(tmp_path, is_isolated, signum, printed):
    program = ("import sys, time; from pathlib import Path; from driving_tasks import contained\n"
               f"contained.can_isolate = lambda: {is_isolated}\n"
               "def wait():\n    Path(sys.argv[1], 'ready').touch()\n    time.sleep(60)\n"
               "try:\n    contained.run(wait)\nexcept KeyboardInterrupt:\n    print('cancelled')")
    with subprocess.Popen([sys.executable, "-c", program, str(tmp_path)], env=ENVIRONMENT, stdout=subprocess.PIPE,
                          start_new_session=True) as parent:
        assert wait_until((tmp_path / "ready").exists, 10)
        os.killpg(parent.pid, signum)
        assert parent.communicate(timeout=10)[0] == printed
    assert wait_until(lambda: not running(tmp_path), 5)
