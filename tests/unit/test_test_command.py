"""./morbot test runs its parts one after the other, each to its end; SIGTERM and Ctrl-C end it with all it started."""

import os
import signal
import subprocess

import pytest

from conftest import ROOT
from jetbot.wait import wait_until

pytestmark = pytest.mark.shell
RUN = """. "$0"; here=.
python3() { case "$*" in *tests/browser) echo $$ >>browser ;; *) %s ;; esac; }
run_tests "$@" """

CLEANS_UP = """
import signal, time
for signum in signal.SIGINT, signal.SIGTERM:
    signal.signal(signum, signal.default_int_handler)
try:
    open("begun", "w")
    time.sleep(60)
except KeyboardInterrupt:
    open("cleaned", "w")"""


@pytest.fixture
def run(tmp_path):
    """A function that starts run_tests with these lines as the first part."""
    def run(lines, *arguments):
        return subprocess.Popen(["sh", "-c", RUN % lines, str(ROOT / "setup/tests.sh"), *arguments], cwd=tmp_path,
                                start_new_session=True)
    return run


@pytest.mark.parametrize("first, code", [("true", 0), ("false", 1)])
def test_each_part_runs_and_one_that_fails_fails_the_whole(run, tmp_path, first, code):
    assert run(first).wait(10) == code
    assert (tmp_path / "browser").exists()


@pytest.mark.parametrize("send, signum, code", [(os.kill, signal.SIGTERM, 143), (os.killpg, signal.SIGINT, 130)],
                         ids=["SIGTERM", "Ctrl-C"])
def test_a_signal_ends_the_part_that_runs_and_no_other_follows(run, tmp_path, send, signum, code):
    tests = run(f"exec python3 -c '{CLEANS_UP}'")
    assert wait_until((tmp_path / "begun").exists, 10)
    send(tests.pid, signum)
    assert tests.wait(10) == code
    assert (tmp_path / "cleaned").exists() and not (tmp_path / "browser").exists()
