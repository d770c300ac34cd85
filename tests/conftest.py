"""What all tests share: which process of pytest-xdist runs them, and that they leave no process behind."""

import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parent / "ros"))
from processes import end_on_sigterm  # noqa: E402

IN_ONE_PROCESS = "tests/browser/"  # they share a world and its browsers


def pytest_configure():
    """End the fixtures also if the tests are ended by SIGTERM."""
    end_on_sigterm()


@pytest.hookimpl(optionalhook=True)  # pytest-xdist may be missing
def pytest_xdist_make_scheduler(config, log):
    """Give each process one test after the other, and all those in a browser to the same one."""
    from xdist.scheduler import LoadScopeScheduling

    class Scheduling(LoadScopeScheduling):
        def _split_scope(self, nodeid):
            return IN_ONE_PROCESS if nodeid.startswith(IN_ONE_PROCESS) else nodeid

    return Scheduling(config, log)
