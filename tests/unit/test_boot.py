"""The first import of a script: Ctrl-C during the others ends it without a word."""

import os
import signal
import subprocess
import sys

import pytest

from conftest import PACKAGES, PYTHONPATH


@pytest.mark.parametrize("script", [
    "driving_tasks/scripts/class_judge.py", "driving_tasks/scripts/judge.py", "jetbot_camera/scripts/camera.py",
    "jetbot_cockpit/scripts/cockpit.py", "jetbot_control_node/scripts/jetbot_controller.py",
    "jetbot_tools/scripts/doctor.py", "jetbot_tools/scripts/emergency_stop.py", "simulation/scripts/simulator.py"])
def test_ctrl_c_while_a_script_imports_prints_no_traceback(script, tmp_path):
    for stub in "rospy.py", "jetbot.py":  # rospy's place, for where ROS is not installed
        (tmp_path / stub).write_text("import signal\nsignal.raise_signal(signal.SIGINT)\n")
    ended = subprocess.run([sys.executable, PACKAGES / script], capture_output=True, timeout=30,
                           env={**os.environ, "PYTHONPATH": f"{tmp_path}:{PYTHONPATH}"})
    assert (ended.returncode, ended.stdout, ended.stderr) == (-signal.SIGINT, b"", b"")
