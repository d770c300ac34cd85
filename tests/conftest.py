"""What all tests share: their order, which process of pytest-xdist runs them, and that they leave none behind."""

import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parent / "ros"))
from processes import end_on_sigterm  # noqa: E402

BEHAVIOURS = "tests/ros/test_rostests.py"
LONGEST = [  # the longest first; as each process is given two at once, the seventh waits for the first
    "test_your_own_package_and_the_other_pages", "test_first_lessons",
    "test_rostest[check_lesson]", "test_rostest[workshop]", "test_rostest[emergency_stop]",
    "test_rostest[calibration]", "test_rostest[standing_order]", "test_rostest[diagnostics]",
    "test_rostest[stop_at_shutdown]", "test_rostest[simulator]", "test_rostest[cockpit_launch]",
    "test_rostest[start_errors]", "test_all_other_packages_are_built_and_work",
    "test_rostest[simulation_launch]", "test_rostest[many_robots]"]
IN_ONE_PROCESS = "tests/browser/"  # they share a world and its browsers


def pytest_configure():
    """End the fixtures also if the tests are ended by SIGTERM."""
    end_on_sigterm()


def pytest_collection_modifyitems(items):
    """Start with the longest tests, then the other behaviours: no process is left with one at the end."""
    order = {name: number for number, name in enumerate(LONGEST)}
    items.sort(key=lambda item: (order.get(item.name, len(order)), not item.nodeid.startswith(BEHAVIOURS)))


@pytest.hookimpl(optionalhook=True)  # pytest-xdist may be missing
def pytest_xdist_make_scheduler(config, log):
    """Give each process one test after the other, and all those in a browser to the same one."""
    from xdist.scheduler import LoadScopeScheduling

    class Scheduling(LoadScopeScheduling):
        def _split_scope(self, nodeid):
            return IN_ONE_PROCESS if nodeid.startswith(IN_ONE_PROCESS) else nodeid

    return Scheduling(config, log)
