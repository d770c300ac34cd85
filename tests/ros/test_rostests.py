"""Runs each behaviour below a ROS master of its own, one of them as ``rostest`` does by hand."""

import multiprocessing
import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

import pytest
import rosgraph
import rospy
from rosmaster.main import rosmaster_main

from jetbot.wait import wait_until
from processes import SHUTDOWN_TIMEOUT, end_with_parent, free_port

FOLDER = Path(__file__).parent
BEHAVIOURS = sorted(path.stem for path in FOLDER.glob("behaviours/*.py"))
BY_HAND = "connections"
TIMEOUT = 240.0  # s
FORK = multiprocessing.get_context("fork")  # has imported ROS already, which takes a new process 0.3 s of CPU time


@pytest.mark.filterwarnings("ignore:.*multi-threaded.*fork:DeprecationWarning")  # the thread of pytest-xdist only reads
@pytest.mark.parametrize("behaviour", BEHAVIOURS)
def test_rostest(behaviour, tmp_path):
    run = run_by_hand if behaviour == BY_HAND else run_below_a_master
    code, printed = run(behaviour, tmp_path)
    assert code == 0, printed
    for reason in re.findall(r"skipped ['\"](.*)['\"]$", printed, re.MULTILINE):
        pytest.skip(reason)


def run_by_hand(behaviour, folder):
    """Run rostest; return its exit code and its output."""
    run = subprocess.run(["rostest", FOLDER / "behaviour.test", f"test:={behaviour}"], text=True, timeout=TIMEOUT,
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env={**os.environ, "ROS_HOME": str(folder)})
    return run.returncode, run.stdout


def run_below_a_master(behaviour, folder):
    """Run a master and a behaviour in processes of their own; return the behaviour's exit code and its output."""
    port, log = free_port(), folder / "printed"
    uri = f"http://localhost:{port}"
    master = FORK.Process(target=in_process, args=(folder, uri, folder / "master", serve, port))
    test = FORK.Process(target=in_process, args=(folder, uri, log, check, behaviour))
    try:
        master.start()
        assert wait_until(lambda: rosgraph.is_master_online(uri), TIMEOUT), "no master"
        test.start()
        test.join(TIMEOUT)
        return test.exitcode, log.read_text()
    finally:
        for process in test, master:
            if process.pid:
                process.terminate()
                process.join(SHUTDOWN_TIMEOUT)
                process.kill()


def in_process(home, uri, log, act, argument):
    """Call a function in this process, which writes into this file, and ends with the one that started it."""
    end_with_parent()
    os.environ.update(ROS_HOME=str(home), ROS_MASTER_URI=uri)
    with log.open("w") as file:
        for output in 1, 2:
            os.dup2(file.fileno(), output)
    sys.stdout = sys.stderr = os.fdopen(1, "w", 1)
    act(argument)


def serve(port):
    rosmaster_main(["rosmaster", "--core", "-p", str(port)])


def check(behaviour):
    rospy.init_node(f"test_{behaviour}", argv=[], disable_signals=True)  # rospy goes on after SIGTERM
    suite = unittest.defaultTestLoader.loadTestsFromName(f"behaviours.{behaviour}")
    try:
        done = unittest.TextTestRunner(verbosity=2).run(suite)
    finally:
        rospy.signal_shutdown("the end")
    sys.exit(not done.wasSuccessful())
