"""The file that calibrate.py writes."""

import os
import runpy

import pytest

from conftest import SOURCE
from jetbot import JetbotError

calibrate = runpy.run_path(str(SOURCE / "scripts/calibrate.py"))


@pytest.fixture
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("ROS_HOME", str(tmp_path))
    return tmp_path


def test_says_how_to_undo_it_and_that_works(home, capsys):
    file = home / "a b.yaml"
    file.write_text("old")
    file.with_name("link").symlink_to(file)
    calibrate["write"](home / "link", "new")
    assert file.read_text() == "new"
    os.system(capsys.readouterr().out.partition("To undo it: ")[2].partition("\n")[0])
    assert file.read_text() == "old" and (home / "link").is_symlink()


@pytest.mark.parametrize("name, make, reason", [
    ("fifo", os.mkfifo, "not a regular file"), ("folder", os.mkdir, "not a regular file"),
    ("large", lambda file: file.touch() or os.truncate(file, 50 * 10**9), "larger than 64 kB"),
    ("loop", lambda file: file.symlink_to(file), "Too many levels of symbolic links"),
    ("link", lambda file: file.symlink_to("no/file"), "No such file or directory"),
    ("file/x", lambda file: file.parent.touch(), "File exists")])
def test_a_file_that_cannot_be_written_is_refused_before_any_question(home, name, make, reason):
    make(home / name)
    with pytest.raises(JetbotError) as error:
        calibrate["output_file"](home / name, False)
    assert str(error.value) == f"The file {home / name} cannot be written: {reason}. Name another with --output."


def test_a_simulated_robot_is_not_written_to_the_real_ones_file_by_another_name(home):
    (home / "link.yaml").symlink_to("jetbot.yaml")
    for name in ("jetbot.yaml", "link.yaml"):
        with pytest.raises(JetbotError, match="is for the real robot, and this one is simulated"):
            calibrate["output_file"](home / name, True)
