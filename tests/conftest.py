"""What all tests share: their order, which process of pytest-xdist runs them, and that they leave none behind."""

import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parent / "ros"))
from processes import end_on_sigterm  # noqa: E402

LONGEST = ("test_pages.py", "test_rostests.py")  # files of the longest tests
IN_ONE_PROCESS = "tests/browser/"  # they share a world and its browsers


def pytest_configure():
    """End the fixtures also if the tests are ended by SIGTERM."""
    end_on_sigterm()


def pytest_collection_modifyitems(items):
    """Start with the longest tests: no process is left with one at the end."""
    items.sort(key=lambda item: not item.location[0].endswith(LONGEST))


@pytest.hookimpl(optionalhook=True)  # pytest-xdist may be missing
def pytest_xdist_make_scheduler(config, log):
    """Give each process one test after the other, and all those in a browser to the same one."""
    from xdist.scheduler import LoadScopeScheduling

    class Scheduling(LoadScopeScheduling):
        def _split_scope(self, nodeid):
            return IN_ONE_PROCESS if nodeid.startswith(IN_ONE_PROCESS) else nodeid

    return Scheduling(config, log)
