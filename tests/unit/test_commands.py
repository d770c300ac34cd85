"""./morbot: a command that it does not know is refused with what was meant, and nothing is installed or built."""

import os
import shutil
import subprocess

import pytest

from conftest import ROOT

pytestmark = pytest.mark.shell
COMMANDS = "run class test setup shell doctor calibrate check stop forget robot fleet help"


def morbot(*words, file=ROOT / "morbot", **environment):
    """Run ./morbot; return its exit code and its output."""
    process = subprocess.run(["sh", file, *words], env={**os.environ, **environment}, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=60)
    return process.returncode, process.stdout


@pytest.fixture
def without_python(tmp_path):
    """A PATH with nothing but what ./morbot needs before it looks for a command."""
    for tool in ("readlink", "tr", "sh"):
        (tmp_path / tool).symlink_to(next(f"{folder}/{tool}" for folder in ("/bin", "/usr/bin")
                                          if os.path.exists(f"{folder}/{tool}")))
    return str(tmp_path)


NO_MASTER = "No ROS master at http://localhost:1, so no robot can be reached. If a robot moves, use its switch."
LIST = f"The commands are: {COMMANDS}"


@pytest.mark.parametrize("words, code, printed", [
    *((typed, 2, f"morbot: there is no command {typed}. Did you mean ./morbot {meant}?") for typed, meant in [
        ("rnu", "run"), ("Run", "run"), ("--run", "run"), ("docter", "doctor"), ("calibarte", "calibrate"),
        ("STOP", "stop"), ("forgett", "forget")]),
    ("xyzzy", 2, f"morbot: there is no command xyzzy. {LIST}"),
    ("\x1b[2J", 2, f"morbot: there is no command ?[2J. {LIST}"),
    ("setup now", 1, "morbot: setup takes no arguments, and not now"),
    ("stop --relase", 1, "There is no option --relase. Did you mean --release?"),
    ("stop", 1, NO_MASTER),
    ("stop now", 1, f"There is no option now: this stops every robot.\n{NO_MASTER}")])
def test_what_is_mistyped_is_refused_but_a_stop_is_a_stop(words, code, printed):
    assert morbot(*words.split(), ROS_MASTER_URI="http://localhost:1") == (code, f"{printed}\n")


def test_without_python_there_is_no_suggestion(without_python):
    assert morbot("rnu", PATH=without_python)[1].endswith(f"no command rnu. {LIST}\n")


@pytest.mark.parametrize("words", [[], ["help"], ["-h"], ["--help"]])
def test_the_usage_names_every_command(words):
    code, printed = morbot(*words)
    assert code == 0
    assert set(COMMANDS.split()) - {"help"} == {line.split()[0] for line in printed.splitlines()[1:]}
    assert max(map(len, printed.splitlines())) <= 120


def test_a_stop_works_in_a_folder_whose_name_nothing_else_takes(tmp_path):
    (tmp_path / "a b").mkdir()
    for name in "setup", "morbot_ws":
        (tmp_path / "a b" / name).symlink_to(ROOT / name)
    shutil.copy(ROOT / "morbot", tmp_path / "a b")
    assert morbot("stop", file=tmp_path / "a b/morbot", ROS_MASTER_URI="http://localhost:1") == (1, f"{NO_MASTER}\n")
