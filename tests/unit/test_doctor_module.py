"""What the doctor says of two modules called jetbot: MorBot's and NVIDIA's."""

import os
import subprocess
import sys

import pytest

from conftest import ROOT
from jetbot_tools.doctor import checkup, jetbot_module

SOURCE = ROOT / "morbot_ws/src"
OWN = SOURCE / "jetbot/src"
RELAY = "# generated from catkin/cmake/template/__init__.py.in\n"


@pytest.fixture
def nvidia(tmp_path):
    """Return a folder with NVIDIA's module, which needs what is not installed here."""
    return module(tmp_path / "nvidia", motor="")


def module(folder, begin="import Adafruit_MotorHAT\n", **files):
    (folder / "jetbot").mkdir(parents=True)
    for name, text in {"__init__": begin, **files}.items():
        (folder / f"jetbot/{name}.py").write_text(text)
    return folder


def test_both_are_named_with_what_to_do(nvidia, monkeypatch):
    monkeypatch.setattr(sys, "path", [str(OWN), str(nvidia)])
    assert list(map(str, checkup.check_jetbot())) == [
        f"ok  jetbot: MorBot's is imported, from {OWN}/jetbot; NVIDIA's is in {nvidia}/jetbot. "
        "Programs that are started elsewhere import that one: type ./morbot shell"]


def test_nothing_is_said_where_all_are_morbots(tmp_path, monkeypatch):
    devel = module(tmp_path / "devel", RELAY)
    monkeypatch.setattr(sys, "path", [str(OWN), str(OWN), str(devel), str(tmp_path), str(tmp_path / "none")])
    assert not list(checkup.check_jetbot())


def test_one_of_nobody_known(tmp_path):
    other, file = module(tmp_path / "other"), tmp_path / "jetbot.py"
    file.touch()
    assert jetbot_module.finding([str(other)]) == f"another one is imported, from {other}/jetbot"
    assert jetbot_module.finding([str(OWN), str(tmp_path)]).endswith(f"; another one is in {file}")


def test_the_doctor_says_it_where_nvidias_is_imported(nvidia):
    others = [str(folder) for folder in SOURCE.glob("*/src")]
    ended = subprocess.run([sys.executable, str(SOURCE / "jetbot_tools/scripts/doctor.py")], text=True,
                           stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                           env={**os.environ, "PYTHONPATH": os.pathsep.join([str(nvidia), *others])})
    assert ended.returncode == 1
    assert ended.stdout == (f"NOT jetbot: NVIDIA's is imported, from {nvidia}/jetbot. "
                            "Type: unset PYTHONPATH   and start this again in ./morbot shell.\n")
