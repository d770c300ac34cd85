"""Runs every .test file here by rostest, as one would by hand."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

FILES = sorted(Path(__file__).parent.glob("*.test"))
PROGRAMS = {"show_in_rviz": ("rviz", "Xvfb", "convert")}  # what a test needs that ./morbot setup does not install


@pytest.mark.parametrize("file", FILES, ids=[file.stem for file in FILES])
def test_rostest(file, tmp_path):
    missing = [program for program in PROGRAMS.get(file.stem, ()) if not shutil.which(program)]
    if missing:
        pytest.skip(f"{', '.join(missing)} not installed; sudo apt install rviz xvfb imagemagick libgl1-mesa-dri")
    run = subprocess.run(["rostest", str(file)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                         env={**os.environ, "ROS_HOME": str(tmp_path)}, text=True, timeout=240)
    assert run.returncode == 0, run.stdout
