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


def check(python, tmp_path, program):
    """Return what mypy reports of a program, without the names of the files."""
    (tmp_path / "program.py").write_text(f"from jetbot import BusError, Camera, Robot\n\nrobot = Robot()\n{program}\n")
    done = subprocess.run([MYPY, "--strict", "--config-file=", "--python-executable", python, "program.py"],
                          cwd=tmp_path, stdout=subprocess.PIPE, text=True)
    return [line.partition("error: ")[2] for line in done.stdout.splitlines() if "error: " in line]


def test_a_program_that_uses_the_names_of_the_library_is_correct(python, tmp_path):
    assert check(python, tmp_path, """
with robot:
    robot.set_motors(1, -0.5)
    robot.left_motor.value = robot.right_motor.value + 0.1
    try:
        robot.left(speed=0.3)
    except BusError as error:
        print(error.reason, error.errno)
Camera.instance(width=224).stop()""") == []


@pytest.mark.parametrize("line, problem", [
    ("robot.set_motorz(1)", '"Robot" has no attribute "set_motorz"; maybe "set_motors"'),
    ('robot.set_motors("a", 1)', 'Argument 1 to "set_motors" of "Robot" has incompatible type "str"; expected "float"'),
    ("robot.left_motor.valeu = 1", '"Motor" has no attribute "valeu"'),
    ('robot.left_motor.value = "fast"', 'Incompatible types in assignment (expression has type "str", variable has'),
    ("Robot(boardd='adafruit')", 'Unexpected keyword argument "boardd" for "Robot"'),
    ("Camera(widht=3)", 'Unexpected keyword argument "widht" for "Camera"')])
def test_a_mistake_is_found(python, tmp_path, line, problem):
    found, = check(python, tmp_path, line)
    assert found.startswith(problem)
