"""The nodes in tests/nodes print with ROS what they print in a page (tests/js/modules.test.js)."""

import subprocess
import sys
from pathlib import Path

import pytest

from processes import end, free_port, start

FOLDER = Path(__file__).parent
NODES = {path.stem: path for path in FOLDER.parent.glob("nodes/*.py")}
TIMEOUT = 60.0  # s
TRIES = 3  # as a computer that is busy runs timers late


@pytest.fixture(scope="module", autouse=True)
def robot(tmp_path_factory):
    """A master, and a robot that stands still and reports."""
    folder, port = tmp_path_factory.mktemp("robot"), free_port()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_MASTER_URI", f"http://localhost:{port}")
        patch.setenv("ROS_HOME", str(folder))
        processes = [start(["rosmaster", "--core", "-p", str(port)], folder / "master")]
        try:
            processes.append(start([sys.executable, str(FOLDER / "robot_reports.py")], folder / "robot"))
            yield
        finally:
            end(processes)


@pytest.mark.parametrize("name", NODES)
def test_a_node_prints_with_ros_what_it_prints_in_a_page(name):
    expected = [line[3:] for line in NODES[name].read_text().splitlines() if line.startswith("#>")]
    for _ in range(TRIES):
        run = subprocess.run([sys.executable, NODES[name]], capture_output=True, text=True, timeout=TIMEOUT)
        printed = [line.rstrip() for line in run.stdout.splitlines()]
        if printed == expected:
            break
    assert run.returncode == 0, run.stderr
    assert printed == expected, run.stderr
