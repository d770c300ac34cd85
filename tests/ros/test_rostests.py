"""Runs every .test file here by rostest, as one would by hand."""

import os
import subprocess
from pathlib import Path

import pytest

FILES = sorted(Path(__file__).parent.glob("*.test"))


@pytest.mark.parametrize("file", FILES, ids=[file.stem for file in FILES])
def test_rostest(file, tmp_path):
    run = subprocess.run(["rostest", str(file)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                         env={**os.environ, "ROS_HOME": str(tmp_path)}, text=True, timeout=120)
    assert run.returncode == 0, run.stdout
