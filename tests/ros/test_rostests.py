"""Runs each behaviour below a ROS master of its own, one of them as ``rostest`` does by hand."""

import os
import subprocess
from pathlib import Path

import pytest

from harness import free_port

FOLDER = Path(__file__).parent
BEHAVIOURS = sorted(path.stem for path in FOLDER.glob("behaviours/*.py"))
BY_HAND = "connections"  # the others do without rostest's 1.5 s of CPU time
TIMEOUT = 240.0  # s


@pytest.mark.parametrize("behaviour", BEHAVIOURS)
def test_rostest(behaviour, tmp_path):
    run = (run_by_hand if behaviour == BY_HAND else run_below_a_master)(behaviour, {**os.environ, "ROS_HOME": tmp_path})
    assert run.returncode == 0, run.stdout


def run_by_hand(behaviour, environment):
    return finish(["rostest", FOLDER / "behaviour.test", f"test:={behaviour}"], environment)


def run_below_a_master(behaviour, environment):
    port = str(free_port())
    environment["ROS_MASTER_URI"] = f"http://localhost:{port}"
    with subprocess.Popen(["rosmaster", "--core", "-p", port], env=environment, stdout=subprocess.DEVNULL) as master:
        try:
            return finish([FOLDER / "behaviour.py", behaviour, "--text"], environment)
        finally:
            master.terminate()


def finish(command, environment):
    """Run a command to its end; return the process, with its whole output."""
    return subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          timeout=TIMEOUT)
