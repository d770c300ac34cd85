"""What runs in a child with limits: whatever it does, the program goes on with a sentence about it."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from unittest.mock import Mock

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
    (os._exit, (3,), "It needs more than 200 MB of memory, or breaks the program that reads it."),
    (spin, (), "It takes more than 1 s of CPU time."),
], ids=["error", "memory", "crash", "endless"])
def test_what_fails_in_a_child_is_a_problem_in_one_sentence(function, arguments, problem):
    assert run(function, *arguments, limits=SMALL) == (None, problem)


def test_a_function_that_waits_ends():
    assert run(time.sleep, 60, limits=SMALL._replace(wall_time=0.1)).problem == "It takes more than 0.1 s."


def test_processes_of_others_may_end_while_a_child_starts(monkeypatch):
    monkeypatch.setattr(contained, "children", lambda: [])
    monkeypatch.setattr(Path, "glob", Mock(side_effect=FileNotFoundError("/proc/7/task")))
    assert run(int, "3").value == 3


def test_a_child_prints_nothing_and_returns_much(capfd):
    assert run(os.system, "echo hello; echo hello >&2").value == 0
    assert len(run(bytes, 10 ** 7).value) == 10 ** 7
    assert capfd.readouterr() == ("", "")


def test_a_child_writes_no_file(tmp_path):
    assert "File too large" in run(write, tmp_path / "new").problem
    assert (tmp_path / "new").stat().st_size == 0


def leave_a_process(folder):
    """Start a process that starts another one in a session of its own, and ends; return the id of the other one."""
    contained.start(["sh", "-c", "setsid sleep 60 & echo $! > pid"], folder, folder / "log").wait()
    return (folder / "pid").read_text().strip()


def test_what_a_child_leaves_behind_ends_with_it(tmp_path):
    process = run(leave_a_process, tmp_path, limits=SMALL._replace(file_size=1)).value
    assert process and not Path("/proc", process).exists()


@pytest.mark.parametrize("signum, printed", [(signal.SIGKILL, b""), (signal.SIGINT, b"cancelled\n")])
def test_the_child_ends_with_the_program(signum, printed):
    program = ("import time; from driving_tasks.contained import run\ntry:\n"
               "    run(time.sleep, 60)\nexcept KeyboardInterrupt:\n    print('cancelled')")
    with subprocess.Popen([sys.executable, "-c", program], env=ENVIRONMENT, stdout=subprocess.PIPE,
                          start_new_session=True) as parent:
        children = Path(f"/proc/{parent.pid}/task/{parent.pid}/children")
        assert wait_until(children.read_text, 10)
        child = Path(f"/proc/{children.read_text().strip()}/stat")
        assert wait_until(lambda: os.getsid(int(child.parent.name)) == int(child.parent.name), 5)
        os.killpg(parent.pid, signum)
        assert parent.communicate(timeout=10)[0] == printed
    assert wait_until(lambda: not child.exists() or " Z " in child.read_text(), 5)
