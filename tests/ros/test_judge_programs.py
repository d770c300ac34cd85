"""judge.py --program runs programs, judges how they drive, and leaves nothing of them behind."""

import csv
import os
import signal
import subprocess

import pytest
from roslib.packages import find_node

from driving_tasks.scoring.tasks import TASKS
from driving_tasks.sources.handed_in import judge_programs
from harness import START_TIMEOUT, find_processes, read
from jetbot import InvalidValue
from jetbot.wait import wait_until
from processes import end, start

JUDGE = find_node("driving_tasks", "judge.py")[0]
TIMEOUT = 90.0  # s
DRIVES = """
import os, signal, time
import rospy
from geometry_msgs.msg import Twist

open(os.path.expanduser("~/in_home"), "w").close()
if os.fork() == 0:
    os.setsid()
    time.sleep(1000)
rospy.init_node("pupil", disable_signals=True)
signal.signal(signal.SIGTERM, signal.SIG_IGN)
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
drive, stop, end = Twist(), Twist(), None
drive.linear.x = 0.5
while True:
    if publisher.get_num_connections():
        end = end or time.time() + 3.3
        publisher.publish(drive if time.time() < end else stop)
    time.sleep(0.05)
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder of programs; the files of each one that runs are below it too."""
    (tmp_path / "programs").mkdir()
    (tmp_path / "home").mkdir()
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    yield tmp_path
    assert wait_until(lambda: not find_processes(str(tmp_path)), START_TIMEOUT)


def test_a_program_gets_a_score_and_one_that_crashes_a_row(folder):
    (folder / "programs/drives.py").write_text(DRIVES)
    (folder / "programs/other.py").write_text("from jetbot import Robot\nwith Robot() as robot:\n    robot.forward()\n")
    (folder / "programs/breaks.py").write_text("import missing_module\n")
    run = subprocess.run([JUDGE, "metre", "--program", folder / "programs", "--variation", "0.1"], cwd=folder,
                         stdout=subprocess.PIPE, text=True, timeout=TIMEOUT)
    breaks, drives, other = csv.DictReader(run.stdout.splitlines())
    assert breaks["problem"] == ("It ended before it drove. "
                                 "ModuleNotFoundError: No module named 'missing_module' (line 1)")
    assert (drives["robot"], drives["name"]) == ("", "drives.py") and 60 < float(drives["score"]) < 95
    assert drives["source"] == "simulator with variation 0.1"
    assert other["problem"] == ("It ended before it drove. It drove a Robot() of its own; "
                                "the robot that is judged obeys /cmd_vel.")
    assert sorted(os.listdir(folder)) == ["home", "programs"]
    assert not (folder / "home/in_home").exists()


def test_a_judge_that_is_killed_leaves_no_program_behind(folder):
    (folder / "leaves.py").write_text(
        "import os, time\nif os.fork() == 0:\n    os.setsid()\n    open('begun', 'w')\ntime.sleep(1000)\n")
    judge = start([JUDGE, "metre", "--program", folder / "leaves.py"], folder / "log", cwd=folder)
    try:
        assert wait_until(lambda: list(folder.glob("judge_*/home/begun")), START_TIMEOUT), read(judge)
        os.kill(judge.pid, signal.SIGKILL)
        assert wait_until(lambda: not find_processes("leaves.py"), START_TIMEOUT)
        assert wait_until(lambda: not list(folder.glob("judge_*")), START_TIMEOUT)
    finally:
        end([judge])


def test_a_config_that_the_controller_refuses_is_named_before_a_program_runs():
    with pytest.raises(InvalidValue, match="There is no file .*nothing.yaml"):
        next(judge_programs(TASKS["metre"], "drives.py", "nothing.yaml"))
