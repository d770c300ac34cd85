"""What all tests share: an environment, their order, the processes that run them; they leave none behind."""

import os
import re
import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parent / "ros"))
from processes import end_on_sigterm  # noqa: E402

PAGES = "::test_pages["
LONGEST = (PAGES, "::test_the_page[python_worker.test.js]", "/test_fleet_update.py::", "::test_rostest[class_judge]",
           "::test_rostest[judge]", "::test_rostest[check_lesson]", "::test_rostest[")
FLEET = "tests/fleet/"  # all of these share one school
BROWSER = "tests/browser/"  # the files that a process runs of these tests share a world and its browsers
SLOWEST = [f"{BROWSER}test_{name}.py" for name in (  # of a browser's files, the longest first
    "states", "program", "engines", "python_page", "sharing", "curves", "hub_page", "camera", "work", "accessibility",
    "keys", "python_safety", "driving", "stop", "page", "tablet_lesson", "python_page_equal", "access", "dead_man")]
PROCESSES = 8  # of ./morbot test
OF_A_ROBOT = re.compile("JETBOT_|MORBOT$|ROSCONSOLE_|ROS_(MASTER_URI|IP|NAMESPACE|LOG_DIR)$|PYTHONWARNINGS$")
ALLOWED_SKIPS = {  # in CI, where any other skip is an error: a part of a test's id, and why it may be skipped there
    "-4_keyboard]": "it clones a repository, which needs the internet",
    "test_without_a_home_settings_and_logs_are_in_a_folder_of_the_user": "root may write all; CI has a user, too",
    "test_a_fresh_clone_that_a_user_may_not_write_is_built": "root may write all; CI has a user, too",
    "test_rostest[two_computers]": "a user may make no network namespaces",
    "test_notebooks.py": "NVIDIA's notebooks have no license that lets this project carry them",
    "[in a PID namespace]": "most containers forbid PID namespaces",
    "test_nothing_in_a_namespace_reaches_the_judge": "most containers forbid PID namespaces",
}


def pytest_addoption(parser):
    parser.addoption("--long", action="store_true", help="run what is marked as long, too, which takes an hour")


def pytest_configure(config):
    """Forget the robot of the shell that starts the tests; end the fixtures also if the tests are ended by SIGTERM."""
    config.addinivalue_line("markers", "long: runs with --long alone")
    for name in filter(OF_A_ROBOT.match, list(os.environ)):
        del os.environ[name]
    os.environ["ROS_HOSTNAME"] = "localhost"
    end_on_sigterm()


@pytest.hookimpl(hookwrapper=True)
def pytest_make_collect_report(collector):
    refuse_skip((yield).get_result())


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item):
    refuse_skip((yield).get_result())


def refuse_skip(report):
    """Let a skip fail in CI, unless ALLOWED_SKIPS has it: what is missing there would never be tested."""
    if report.skipped and os.environ.get("CI") == "true" and not any(part in report.nodeid for part in ALLOWED_SKIPS):
        report.outcome = "failed"
        report.longrepr = f"skipped in CI, and not in ALLOWED_SKIPS of tests/conftest.py: {report.longrepr[-1]}"


def scope_of(nodeid):
    """Return what one process runs: a file, a long test or the pages of one pupil."""
    file = nodeid.partition("::")[0]
    if file.startswith(FLEET):
        return FLEET
    if PAGES in nodeid:
        return nodeid[:nodeid.index("-", nodeid.index(PAGES))]
    return nodeid if any(name in nodeid for name in LONGEST if name.startswith("::")) else file


def rank(scope):
    """Return the place of a file with a browser's tests; what is none of SLOWEST comes last, as it is."""
    return SLOWEST.index(scope) if scope in SLOWEST else len(SLOWEST)


def pytest_collection_modifyitems(config, items):
    """Leave out what is long, and start with the longest of the others, so that no process is left with one at the end.

    pytest-xdist gives each process two scopes at once; the second ones are short, as they wait for the first.
    """
    if not config.getoption("--long"):
        config.hook.pytest_deselected(items=[item for item in items if item.get_closest_marker("long")])
        items[:] = [item for item in items if not item.get_closest_marker("long")]
    longest = list(dict.fromkeys(scope_of(item.nodeid) for name in LONGEST for item in items if name in item.nodeid))
    scopes = sorted(dict.fromkeys(scope_of(item.nodeid) for item in items), key=rank)
    others = [scope for scope in scopes if scope not in longest]
    order = longest[:PROCESSES] + others[:PROCESSES] + longest[PROCESSES:] + others[PROCESSES:]
    items.sort(key=lambda item: order.index(scope_of(item.nodeid)))


@pytest.hookimpl(optionalhook=True)  # pytest-xdist may be missing
def pytest_xdist_make_scheduler(config, log):
    """Give each process one scope after the other."""
    from xdist.scheduler import LoadScopeScheduling

    class Scheduling(LoadScopeScheduling):
        def _split_scope(self, nodeid):
            return scope_of(nodeid)

    return Scheduling(config, log)
