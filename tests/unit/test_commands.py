"""./morbot: a command that it does not know is refused with what was meant, and nothing is installed or built."""

import os
import shutil
import subprocess

import pytest

from conftest import ROOT

COMMANDS = "run class test setup shell doctor calibrate check stop forget robot fleet help"


def morbot(*words, **environment):
    """Run ./morbot; return its exit code and its output."""
    process = subprocess.run(["sh", ROOT / "morbot", *words], env={**os.environ, **environment}, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=60)
    return process.returncode, process.stdout


@pytest.fixture
def without_python(tmp_path):
    """A PATH with nothing but what ./morbot needs before it looks for a command."""
    for tool in ("readlink", "tr", "sh"):
        (tmp_path / tool).symlink_to(next(f"{folder}/{tool}" for folder in ("/bin", "/usr/bin")
                                          if os.path.exists(f"{folder}/{tool}")))
    return str(tmp_path)


@pytest.mark.parametrize("typed, meant", [
    ("rnu", "run"), ("Run", "run"), ("--run", "run"), ("docter", "doctor"), ("calibarte", "calibrate"),
    ("STOP", "stop"), ("forgett", "forget")])
def test_a_mistyped_command_is_refused_with_what_was_meant(typed, meant):
    assert morbot(typed) == (2, f"morbot: there is no command {typed}. Did you mean ./morbot {meant}?\n")


@pytest.mark.parametrize("typed, shown", [("xyzzy", "xyzzy"), ("\x1b[2J", "?[2J")])
def test_any_other_word_gets_the_list_of_commands(typed, shown):
    assert morbot(typed) == (2, f"morbot: there is no command {shown}. The commands are: {COMMANDS}\n")


def test_without_python_there_is_no_suggestion(without_python):
    assert morbot("rnu", PATH=without_python)[1].endswith(f"no command rnu. The commands are: {COMMANDS}\n")


@pytest.mark.parametrize("words", [[], ["help"], ["-h"], ["--help"]])
def test_the_usage_names_every_command(words):
    code, printed = morbot(*words)
    assert code == 0
    assert set(COMMANDS.split()) - {"help"} == {line.split()[0] for line in printed.splitlines()[1:]}
    assert max(map(len, printed.splitlines())) <= 120


def test_setup_takes_no_arguments():
    assert morbot("setup", "now") == (1, "morbot: setup takes no arguments, and not now\n")


def test_a_mistyped_release_is_refused():
    assert morbot("stop", "--relase") == (1, "There is no option --relase. Did you mean --release?\n")


def test_a_stop_without_a_master_says_so_and_with_any_other_word_it_is_a_stop():
    no_master = ("No ROS master at http://localhost:1, so no robot can be reached. If a robot moves, use its switch.\n")
    assert morbot("stop", ROS_MASTER_URI="http://localhost:1") == (1, no_master)
    assert morbot("stop", "now", ROS_MASTER_URI="http://localhost:1") == (
        1, f"There is no option now: this stops every robot.\n{no_master}")


def test_a_stop_works_in_a_folder_whose_name_nothing_else_takes(tmp_path):
    (tmp_path / "a b").mkdir()
    for name in "setup", "morbot_ws":
        (tmp_path / "a b" / name).symlink_to(ROOT / name)
    shutil.copy(ROOT / "morbot", tmp_path / "a b")
    stop = subprocess.run([tmp_path / "a b/morbot", "stop"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          encoding="utf-8", env={**os.environ, "ROS_MASTER_URI": "http://localhost:1"})
    assert stop.stdout.startswith("No ROS master at http://localhost:1")
