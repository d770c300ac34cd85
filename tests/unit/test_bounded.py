"""What runs in a child with limits: whatever it does, the program goes on with a sentence about it."""

import mmap
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from driving_tasks.bounded import Limits, run, run_each
from jetbot.wait import wait_until

ENVIRONMENT = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
SMALL = Limits(memory=200, cpu_time=1)


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
], ids=["error", "memory", "crash"])
def test_what_fails_in_a_child_is_a_problem_in_one_sentence(function, arguments, problem, capfd):
    outcome = run(function, *arguments, limits=SMALL)
    assert (outcome.value, outcome.problem) == (None, problem)
    assert capfd.readouterr() == ("", "")


def test_memory_of_the_parent_does_not_count():
    with mmap.mmap(-1, 10 ** 9):
        assert run(abs, -1, limits=SMALL).value == 1


def test_a_function_that_waits_ends():
    assert run(time.sleep, 60, limits=SMALL._replace(wall_time=0.3)).problem == "It takes more than 0.3 s."


def test_endless_calculation_ends():
    assert run(spin, limits=SMALL).problem == "It takes more than 1 s of CPU time."


def test_a_child_prints_nothing(capfd):
    assert run(os.system, "echo hello; echo hello >&2").value == 0
    assert capfd.readouterr() == ("", "")


def test_a_child_writes_no_file(tmp_path):
    assert "File too large" in run(write, tmp_path / "new").problem
    assert (tmp_path / "new").stat().st_size == 0


def test_outcomes_come_in_the_order_of_the_calls():
    assert [each.value for each in run_each(abs, [(-1,), (-2,), (-3,)])] == [1, 2, 3]


def test_a_large_answer_arrives():
    assert len(run(bytes, 10 ** 7).value) == 10 ** 7


def test_the_child_ends_with_a_program_that_is_killed():
    program = "import time; from driving_tasks.bounded import run; run(time.sleep, 60)"
    with subprocess.Popen([sys.executable, "-c", program], env=ENVIRONMENT) as parent:
        children = Path(f"/proc/{parent.pid}/task/{parent.pid}/children")
        assert wait_until(children.read_text, 10)
        child = Path(f"/proc/{children.read_text().strip()}/stat")
        parent.send_signal(signal.SIGKILL)
    assert wait_until(lambda: not child.exists() or " Z " in child.read_text(), 5)


def test_ctrl_c_ends_the_children_too():
    program = ("import time; from driving_tasks.bounded import run_each\ntry:\n"
               "    list(run_each(time.sleep, [(60,), (60,)]))\nexcept KeyboardInterrupt:\n    print('cancelled')")
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          start_new_session=True, env=ENVIRONMENT) as parent:
        children = Path(f"/proc/{parent.pid}/task/{parent.pid}/children")
        assert wait_until(lambda: len(children.read_text().split()) == 2, 10)
        os.killpg(parent.pid, signal.SIGINT)
        assert parent.communicate(timeout=10)[0] == b"cancelled\n"
