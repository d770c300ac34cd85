"""Runs each behaviour, as ``rostest behaviour.test test:=NAME`` does by hand."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

FOLDER = Path(__file__).parent
BEHAVIOURS = sorted(path.stem for path in FOLDER.glob("behaviours/*.py"))
PROGRAMS = {"show_in_rviz": ("rviz", "Xvfb", "convert")}  # that ./morbot setup does not install


@pytest.mark.parametrize("behaviour", BEHAVIOURS)
def test_rostest(behaviour, tmp_path):
    missing = [program for program in PROGRAMS.get(behaviour, ()) if not shutil.which(program)]
    if missing:
        pytest.skip(f"{', '.join(missing)} not installed; sudo apt install rviz xvfb imagemagick libgl1-mesa-dri")
    command = ["rostest", str(FOLDER / "behaviour.test"), f"test:={behaviour}"]
    run = subprocess.run(command, env={**os.environ, "ROS_HOME": str(tmp_path)}, stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, text=True, timeout=240)
    assert run.returncode == 0, run.stdout
