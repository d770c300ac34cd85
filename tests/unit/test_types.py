"""A program that imports jetbot as pip installs it is checked against its types."""

import shutil
import subprocess
import sys
import venv

import pytest

from conftest import PACKAGES, ROOT

OWN = ROOT / "morbot_ws/build/lint/bin/mypy"  # of .ci/run
MYPY = str(OWN) if OWN.exists() else shutil.which("mypy")

pytest.importorskip("setuptools")
pytestmark = pytest.mark.skipif(not MYPY, reason="mypy is not installed")


@pytest.fixture(scope="module")
def python(tmp_path_factory):
    """The interpreter of an environment with what the package's setup.py installs."""
    folder = tmp_path_factory.mktemp("environment")
    venv.create(folder)
    packages, = folder.glob("lib/python*/site-packages")
    subprocess.run([sys.executable, "setup.py", "-q", "build", "-b", folder / "build", "--build-lib", packages],
                   cwd=PACKAGES / "jetbot", check=True)
    return folder / "bin/python"


def test_mypy_finds_the_mistakes_in_a_program_and_nothing_else(python, tmp_path):
    (tmp_path / "program.py").write_text("""\
from jetbot import BusError, Camera, Robot
robot = Robot()
with robot:
    robot.set_motors(1, -0.5)
    robot.left_motor.value = robot.right_motor.value + 0.1
    try:
        robot.left(speed=0.3)
    except BusError as error:
        print(error.reason, error.errno)
Camera.instance(width=224).stop()
robot.set_motorz(1)
robot.set_motors("a", 1)
robot.left_motor.valeu = 1
robot.left_motor.value = "fast"
Robot(boardd='adafruit')
Camera(widht=3)
""")
    done = subprocess.run([MYPY, "--strict", "--config-file=", "--python-executable", python, "program.py"],
                          cwd=tmp_path, stdout=subprocess.PIPE, text=True)
    found = [line.partition("error: ")[2] for line in done.stdout.splitlines() if "error: " in line]
    problems = ['"Robot" has no attribute "set_motorz"; maybe "set_motors"',
                'Argument 1 to "set_motors" of "Robot" has incompatible type "str"; expected "float"',
                '"Motor" has no attribute "valeu"',
                'Incompatible types in assignment (expression has type "str", variable has',
                'Unexpected keyword argument "boardd" for "Robot"', 'Unexpected keyword argument "widht" for "Camera"']
    assert [line.startswith(problem) for line, problem in zip(found, problems)] == [True] * 6, found
    assert len(found) == 6, found
